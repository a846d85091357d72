/// @file Single particles on copies of one surface shape, far apart, in one run of the real engine. What comes back is
/// in each copy's own coordinates: positions lose no digits, moments are about the shape's own origin.
#pragma once

#include "impacts.hpp"

namespace grainstep::dem::shapes {

using surface::Vec2;

/// Where a node that began at `start` is at time t (s).
using Path = std::function<Vec2(double t, const Vec2& start)>;

inline Path at_rest() {
  return [](double, const Vec2& start) { return start; };
}

struct Disc {
  Vec2 position, velocity;  ///< m, m/s
  double spin = 0.0;        ///< 1/s
};

struct Experiment {
  std::vector<Vec2> nodes;      ///< of one open piece, within 20 mm of the origin
  std::vector<Disc> particles;  ///< one for each copy; D = 1 mm
  impacts::Law law{.restitution = 1.0, .friction = 0.0, .lever_is_radius = false};
  double steps_per_contact = 10.0;
  double contact_times = 4.0;  ///< how long
  Path path = at_rest();
  scene::SurfaceContact::Spreading spreading = scene::SurfaceContact::SPREADING_POINT;
};

/// The same with contact over the chord.
inline Experiment over_chord(Experiment experiment) {
  experiment.spreading = scene::SurfaceContact::SPREADING_CHORD;
  return experiment;
}

/// What one copy saw. Particles are free at the start and at the end.
struct Outcome {
  Disc before, after;
  std::vector<Vec2> force;  ///< on the surface at t(n), N; at t(0) none
  Vec2 impulse;             ///< on the surface, N s
  double moment = 0.0;      ///< of that impulse about the origin, from the nodes' places at t(n); N m s
  double work = 0.0;        ///< on the surface, with the mean of the velocities around t(n); J
};

struct Result {
  double dt = 0.0;  ///< s
  double mass = 0.0;
  std::vector<Outcome> copies;
};

inline constexpr double pitch = 0.05;  ///< m between copies
inline constexpr double radius = 0.5e-3;

inline double energy(const Result& result, const Disc& p) {
  return 0.5 * result.mass * (dot(p.velocity, p.velocity) + 0.5 * std::pow(radius * p.spin, 2));
}
inline double angular_momentum(const Result& result, const Disc& p) {
  return result.mass * (p.position[0] * p.velocity[1] - p.position[1] * p.velocity[0] + 0.5 * radius * radius * p.spin);
}

namespace detail {

inline void place(const Experiment& experiment, wire::Setup& setup) {
  wire::Surface& surface = *setup.mutable_impactor()->mutable_surface();
  surface.Clear();
  const std::size_t count = experiment.nodes.size();
  for (std::size_t k = 0; k < experiment.particles.size(); ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      surface.add_position(experiment.nodes[i][0] + pitch * static_cast<double>(k));
      surface.add_position(experiment.nodes[i][1]);
      for (int c = 0; c < 2; ++c) surface.add_velocity(0.0);
      if (i == 0) continue;
      surface.add_facet(static_cast<std::uint32_t>(k * count + i - 1));
      surface.add_facet(static_cast<std::uint32_t>(k * count + i));
    }
  }
}

inline Disc particle_of(const wire::Snapshot& snapshot, std::size_t k) {
  const int i = static_cast<int>(k);
  const wire::Field& velocity = rig::field(snapshot, "velocity");
  return {{{snapshot.position(2 * i) - pitch * static_cast<double>(k), snapshot.position(2 * i + 1)}},
          {{velocity.value(2 * i), velocity.value(2 * i + 1)}},
          rig::field(snapshot, "angular_velocity").value(i)};
}

/// Adds what the copy's nodes received in the step around t(n).
inline void receive(const Experiment& experiment, const wire::Forces& forces, std::size_t k, double dt, Outcome& copy) {
  const double t = dt * static_cast<double>(forces.window());
  Vec2 sum;
  for (std::size_t i = 0; i < experiment.nodes.size(); ++i) {
    const int at = static_cast<int>(2 * (k * experiment.nodes.size() + i));
    const Vec2 given{{forces.impulse(at), forces.impulse(at + 1)}};
    const Vec2& start = experiment.nodes[i];
    const Vec2 x = experiment.path(t, start);
    const Vec2 velocity = (experiment.path(t + dt, start) - experiment.path(t - dt, start)) * (0.5 / dt);
    sum += given;
    copy.moment += x[0] * given[1] - x[1] * given[0];
    copy.work += dot(given, velocity);
  }
  copy.impulse += sum;
  copy.force.push_back(sum * (1.0 / dt));
}

}  // namespace detail

inline Result carry_out(const Experiment& experiment) {
  wire::Setup setup = impacts::setup_of(experiment.law);
  rig::slug_of(setup).mutable_surface_contact()->set_spreading(experiment.spreading);
  detail::place(experiment, setup);
  const SlugModel model = rig::model_of(setup);
  Result result{model.contact_time / experiment.steps_per_contact, model.mass, {}};
  std::vector<PlacedParticle> particles;
  for (const Disc& disc : experiment.particles) {
    const Vec2 origin{{pitch * static_cast<double>(particles.size()), 0.0}};
    particles.push_back({in_space(disc.position + origin), in_space(disc.velocity), disc.spin});
  }
  const auto steps = static_cast<std::uint64_t>(experiment.contact_times * experiment.steps_per_contact);
  const rig::Motion motion = [&](std::uint64_t n, const Vec2& global) {
    const Vec2 origin{{pitch * std::round(global[0] / pitch), 0.0}};
    return origin + experiment.path(result.dt * static_cast<double>(n), global - origin);
  };
  const rig::ScriptedLink link = rig::run(setup, rig::start_of(result.dt, steps), particles, motion);
  for (std::size_t k = 0; k < particles.size(); ++k) {
    Outcome copy{detail::particle_of(link.snapshots.front(), k), detail::particle_of(link.snapshots.back(), k), {}, {}};
    for (const wire::Forces& forces : link.forces) detail::receive(experiment, forces, k, result.dt, copy);
    result.copies.push_back(std::move(copy));
  }
  return result;
}

}  // namespace grainstep::dem::shapes
