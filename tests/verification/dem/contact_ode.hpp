/// @file A single contact by (2.1) and (2.2), integrated as an ordinary differential equation in the plane: what the
/// engine must come to as its step goes to zero. Shares no code with the engine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "impacts.hpp"

namespace grainstep::dem::impacts {

/// One disc against the surface x2 = 0, or against its own point-symmetric image. The line of centres of a pair turns
/// while they touch; the spring turns with it.
class ContactOde {
 public:
  ContactOde(const Law& law, Partner partner)
      : law_(law),
        pair_(partner == Partner::particle),
        mass_(rig::model_of(setup_of(law)).mass),
        share_(pair_ ? 2.0 : 1.0),
        gamma_(0.0),
        duration_(M_PI * std::sqrt(mass_ / share_ / kn)) {
    if (law.restitution >= 1.0) return;
    const double decay = std::pow(M_PI / std::log(law.restitution), 2);
    gamma_ = std::sqrt(4.0 * kn * share_ / mass_ / (1.0 + decay));  // (2.3) with m_eff = mass/share
    duration_ = -2.0 * std::log(law.restitution) / gamma_;          // (2.4)
  }

  static constexpr double radius = 0.5e-3;  ///< m
  static constexpr double kn = 7.3e6;       ///< N/m

  /// Fourth-order Runge-Kutta steps; after each the tangential spring is cut back to the Coulomb limit.
  [[nodiscard]] Motion2 rebound(const Motion2& before, int steps_per_contact = 4000) const {
    const double h = duration_ / steps_per_contact;
    State y{0.0, radius, before.tangential, -before.normal, before.spin, 0.0};
    do {
      const State k1 = rate(y);
      const State k2 = rate(moved(y, k1, 0.5 * h));
      const State k3 = rate(moved(y, k2, 0.5 * h));
      const State k4 = rate(moved(y, k3, h));
      y = moved(moved(moved(moved(y, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
      const double longest = law_.friction * std::abs(contact(y).normal_force) / ks();
      y[5] = std::clamp(y[5], -longest, longest);
    } while (contact(y).overlap > 0.0);
    return {y[3], y[2], y[4]};
  }

 private:
  using State = std::array<double, 6>;  ///< place (2), velocity (2), spin, tangential spring

  struct Contact {
    double n1, n2;        ///< unit normal, towards the disc; the tangent is (n2, -n1)
    double overlap;       ///< m
    double normal_force;  ///< N
  };

  [[nodiscard]] double ks() const { return kn * law_.tangential_ratio; }

  static State moved(State a, const State& b, double factor) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
    return a;
  }

  [[nodiscard]] Contact contact(const State& y) const {
    const double distance = pair_ ? std::hypot(y[0], y[1]) : y[1];
    Contact c{pair_ ? y[0] / distance : 0.0, pair_ ? y[1] / distance : 1.0, share_ * (radius - distance), 0.0};
    const double approach = -share_ * (y[2] * c.n1 + y[3] * c.n2);
    c.normal_force = kn * c.overlap + mass_ / share_ * gamma_ * approach;
    return c;
  }

  [[nodiscard]] State rate(const State& y) const {
    const Contact c = contact(y);
    const double limit = law_.friction * std::abs(c.normal_force);
    const double tangential = std::clamp(-ks() * y[5], -limit, limit);
    const double lever = pair_ || law_.lever_is_radius ? radius : radius - c.overlap;
    const double slip = share_ * (y[2] * c.n2 - y[3] * c.n1 + lever * y[4]);
    const double inertia = mass_ * radius * radius / 2.0;
    return {y[2],
            y[3],
            (c.normal_force * c.n1 + tangential * c.n2) / mass_,
            (c.normal_force * c.n2 - tangential * c.n1) / mass_,
            lever * tangential / inertia,
            slip};
  }

  Law law_;
  bool pair_;
  double mass_, share_, gamma_, duration_;
};

}  // namespace grainstep::dem::impacts
