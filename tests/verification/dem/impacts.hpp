/// @file Many single impacts in one run of the real engine: of particles on a flat surface, or of pairs that meet
/// point-symmetrically (the partner has the opposite velocity and the same spin).
#pragma once

#include <cmath>
#include <vector>

#include "../../unit/dem-service/engine_rig.hpp"

namespace grainstep::dem::impacts {

enum class Partner { surface, particle };

inline const char* name_of(Partner partner) { return partner == Partner::surface ? "surface" : "particle"; }

/// Of one particle. Before the impact `normal` is the approach speed, after it the departure speed (m/s). A positive
/// spin (1/s) adds radius * spin to the tangential slip of the touched point.
struct Motion2 {
  double normal = 0.0, tangential = 0.0, spin = 0.0;
};

struct Law {
  double restitution = 0.7;
  double friction = 0.7;
  double tangential_ratio = 2.0 / 7.0;
  bool lever_is_radius = true;  ///< particles on the surface; pairs always use it
};

/// Reference particles (D = 1 mm) with this law, on a flat surface long enough for anything here.
inline wire::Setup setup_of(const Law& law) {
  wire::Setup setup = rig::reference_setup();
  scene::Slug& slug = rig::slug_of(setup);
  slug.mutable_particle()->set_restitution(law.restitution);
  slug.mutable_particle()->set_friction(law.friction);
  slug.mutable_particle()->set_tangential_ratio(law.tangential_ratio);
  slug.mutable_surface_contact()->set_lever_arm(law.lever_is_radius ? scene::SurfaceContact::LEVER_ARM_RADIUS
                                                                    : scene::SurfaceContact::LEVER_ARM_CONTACT_POINT);
  rig::set_flat_surface(setup, 20.0, 1000);
  return setup;
}

/// Places of first touch within the step: the gap is (i + 1/2)/count of one step's way.
struct Phases {
  double steps_per_contact = 10.0;  ///< dt = t_e/this, t_e that of a pair
  int count = 20;
};

inline Motion2 motion_of(const wire::Snapshot& snapshot, int particle) {
  const wire::Field& velocity = rig::field(snapshot, "velocity");
  return {velocity.value(2 * particle + 1), velocity.value(2 * particle),
          rig::field(snapshot, "angular_velocity").value(particle)};
}

/// All rebounds, [impact][phase]. Each takes at most three contact times.
inline std::vector<std::vector<Motion2>> rebounds(const Law& law, Partner partner, const std::vector<Motion2>& before,
                                                  const Phases& phases) {
  const wire::Setup setup = setup_of(law);
  const SlugModel model = rig::model_of(setup);
  const double dt = model.contact_time / phases.steps_per_contact;
  const bool pairs = partner == Partner::particle;
  const double radius = model.diameter / 2.0;
  const auto count = static_cast<int>(before.size()) * phases.count;
  std::vector<PlacedParticle> particles;
  for (int k = 0; k < count; ++k) {
    const Motion2& motion = before[static_cast<std::size_t>(k / phases.count)];
    const double gap = motion.normal * dt * (k % phases.count + 0.5) / phases.count;
    const double x = 8.0 * model.diameter * (k - count / 2);
    const double height = pairs ? 1.0 : 0.0;
    particles.push_back({{{x, height + radius + gap}}, {{motion.tangential, -motion.normal}}, motion.spin});
    if (pairs) {
      particles.push_back({{{x, height - radius - gap}}, {{-motion.tangential, motion.normal}}, motion.spin});
    }
  }
  const auto steps = static_cast<std::uint64_t>(3.0 * contact_time(model.on_surface) / dt);
  const rig::ScriptedLink link = rig::run(setup, rig::start_of(dt, steps), particles);
  std::vector<std::vector<Motion2>> after(before.size());
  for (int k = 0; k < count; ++k) {
    after[static_cast<std::size_t>(k / phases.count)].push_back(motion_of(link.snapshots.back(), pairs ? 2 * k : k));
  }
  return after;
}

inline Motion2 mean_of(const std::vector<Motion2>& all) {
  Motion2 sum;
  const double share = 1.0 / static_cast<double>(all.size());
  for (const Motion2& one : all) {
    sum.normal += one.normal * share;
    sum.tangential += one.tangential * share;
    sum.spin += one.spin * share;
  }
  return sum;
}

/// Kinetic energy over the mass of a disc of inertia m R^2/2, m^2/s^2.
inline double specific_energy(const Motion2& motion, double radius) {
  return 0.5 * (motion.normal * motion.normal + motion.tangential * motion.tangential +
                0.5 * std::pow(radius * motion.spin, 2));
}

}  // namespace grainstep::dem::impacts
