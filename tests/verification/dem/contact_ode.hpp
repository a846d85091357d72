/// @file A single contact by (2.1) and (2.2), integrated as an ordinary differential equation in the plane: what the
/// engine must come to as its step goes to zero. Shares no code with the engine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "impacts.hpp"

namespace grainstep::dem::impacts {

/// A disc or a sphere.
struct Round {
  double mass = 0.0, radius = 0.0;
  double gyration = 0.5;  ///< moment of inertia over m R^2
};

/// The surface x2 = 0: too heavy to move, without a centre to turn about.
constexpr Round the_surface{std::numeric_limits<double>::infinity(), 0.0, 0.0};

/// How the first body moves seen from the second one: `normal` is the approach speed before, the departure speed after
/// the impact (m/s). A positive spin of either (1/s) adds radius * spin to the tangential slip.
struct Relative {
  double normal = 0.0, tangential = 0.0, spin = 0.0, other_spin = 0.0;
};

/// Two bodies that touch with their line of centres along x2. The line turns while a pair touches; the spring turns
/// with it.
class ContactOde {
 public:
  static constexpr double radius = 0.5e-3;  ///< m, of rig::reference_setup()
  static constexpr double kn = 7.3e6;       ///< N/m, likewise

  /// The reference disc on the surface, or against its own point-symmetric image.
  ContactOde(const Law& law, Partner partner)
      : ContactOde(law, kn, {rig::model_of(setup_of(law)).mass, radius},
                   partner == Partner::particle ? Round{rig::model_of(setup_of(law)).mass, radius} : the_surface) {}

  ContactOde(const Law& law, double stiffness, const Round& first, const Round& second)
      : law_(law),
        stiffness_(stiffness),
        first_(first),
        second_(second),
        effective_(1.0 / (1.0 / first.mass + 1.0 / second.mass)),
        duration_(M_PI * std::sqrt(effective_ / stiffness)) {
    if (law.restitution >= 1.0) return;
    const double decay = std::pow(M_PI / std::log(law.restitution), 2);
    gamma_ = std::sqrt(4.0 * stiffness / effective_ / (1.0 + decay));  // (2.3)
    duration_ = -2.0 * std::log(law.restitution) / gamma_;             // (2.4)
  }

  /// Fourth-order Runge-Kutta steps; after each the tangential spring is cut back to the Coulomb limit.
  [[nodiscard]] Relative rebound(const Relative& before, int steps_per_contact = 4000) const {
    const double h = duration_ / steps_per_contact;
    State y{0.0, first_.radius + second_.radius, before.tangential, -before.normal, before.spin, before.other_spin,
            0.0};
    do {
      const State k1 = rate(y);
      const State k2 = rate(moved(y, k1, 0.5 * h));
      const State k3 = rate(moved(y, k2, 0.5 * h));
      const State k4 = rate(moved(y, k3, h));
      y = moved(moved(moved(moved(y, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
      const double longest = law_.friction * std::abs(contact(y).normal_force) / ks();
      y[6] = std::clamp(y[6], -longest, longest);
    } while (contact(y).overlap > 0.0);
    return {y[3], y[2], y[4], y[5]};
  }

  /// Of the one disc; its image moves likewise.
  [[nodiscard]] Motion2 rebound(const Motion2& before) const {
    const double share = on_surface() ? 1.0 : 2.0;
    const Relative after = rebound({share * before.normal, share * before.tangential, before.spin, before.spin});
    return {after.normal / share, after.tangential / share, after.spin};
  }

 private:
  using State = std::array<double, 7>;  ///< place (2) and velocity (2) seen from the second, spins (2), spring

  struct Contact {
    double n1, n2;        ///< unit normal, towards the first; the tangent is (n2, -n1)
    double overlap;       ///< m
    double normal_force;  ///< N
  };

  [[nodiscard]] bool on_surface() const { return second_.radius == 0.0; }
  [[nodiscard]] double ks() const { return stiffness_ * law_.tangential_ratio; }

  static State moved(State a, const State& b, double factor) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
    return a;
  }

  [[nodiscard]] Contact contact(const State& y) const {
    const double distance = on_surface() ? y[1] : std::hypot(y[0], y[1]);
    Contact c{on_surface() ? 0.0 : y[0] / distance, on_surface() ? 1.0 : y[1] / distance,
              first_.radius + second_.radius - distance, 0.0};
    const double approach = -(y[2] * c.n1 + y[3] * c.n2);
    c.normal_force = stiffness_ * c.overlap + effective_ * gamma_ * approach;
    return c;
  }

  /// Of a body's spin, under a tangential force that acts at `lever` from its centre.
  static double spin_rate(const Round& body, double lever, double force) {
    return lever == 0.0 ? 0.0 : lever * force / (body.gyration * body.mass * body.radius * body.radius);
  }

  [[nodiscard]] State rate(const State& y) const {
    const Contact c = contact(y);
    const double limit = law_.friction * std::abs(c.normal_force);
    const double tangential = std::clamp(-ks() * y[6], -limit, limit);
    const double lever = on_surface() && !law_.lever_is_radius ? first_.radius - c.overlap : first_.radius;
    const double slip = y[2] * c.n2 - y[3] * c.n1 + lever * y[4] + second_.radius * y[5];
    return {y[2],
            y[3],
            (c.normal_force * c.n1 + tangential * c.n2) / effective_,
            (c.normal_force * c.n2 - tangential * c.n1) / effective_,
            spin_rate(first_, lever, tangential),
            spin_rate(second_, second_.radius, tangential),
            slip};
  }

  Law law_;
  double stiffness_;
  Round first_, second_;
  double effective_;    ///< kg
  double gamma_ = 0.0;  ///< 1/s
  double duration_;     ///< s
};

}  // namespace grainstep::dem::impacts
