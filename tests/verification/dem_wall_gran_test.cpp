// A rigid flat surface is LAMMPS's own `fix wall/gran hooke/history`. Same slug, same law on both sides: lever arm of
// one radius, effective mass m, no tension cut-off, the same damping rate, no tangential dashpot.
#include <gtest/gtest.h>

#define LAMMPS_LIB_MPI
#include <lammps/library.h>

#include <cstdio>

#include "../unit/dem-service/engine_rig.hpp"
#include "dem-service/packing.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

constexpr int steps = 1000;

wire::Setup flat() {
  wire::Setup setup = reference_setup();
  slug_of(setup).mutable_surface_contact()->set_lever_arm(scene::SurfaceContact::LEVER_ARM_RADIUS);
  slug_of(setup).set_relative_density(0.05);
  set_flat_surface(setup, 0.2, 60);
  return setup;
}

Vec2 momentum(LammpsSession& session) {
  const int count = *static_cast<int*>(lammps_extract_global(session.handle(), "nlocal"));
  auto** v = static_cast<double**>(lammps_extract_atom(session.handle(), "v"));
  auto* mass = static_cast<double*>(lammps_extract_atom(session.handle(), "rmass"));
  Vec2 sum;
  for (int i = 0; i < count; ++i) sum += Vec2{{mass[i] * v[i][0], mass[i] * v[i][1]}};
  return sum;
}

/// Momentum of the slug at t(0), t(1), ... in plain LAMMPS, started from the places of this snapshot.
std::vector<Vec2> plain_lammps(const wire::Setup& setup, const wire::Snapshot& places, double dt) {
  const SlugModel model = model_of(setup);
  const ContactLaw pair = calibrated_pair_law(model, dt);
  const ContactLaw wall = calibrated_surface_law(model, dt);
  const double radius = model.diameter / 2.0;
  LammpsSession session(alone().communicator, {});
  const auto say = [&](const char* format, auto... values) {
    char text[400];
    std::snprintf(text, sizeof text, format, values...);
    session.command(text);
  };
  for (const char* line :
       {"units si", "atom_style sphere", "dimension 2", "newton on", "boundary m m p", "comm_modify vel yes"}) {
    session.command(line);
  }
  say("region slug block %g %g -0.01 %g %g %g units box", -model.half_width, model.half_width, model.height, -radius,
      radius);
  say("create_box 1 slug");
  std::vector<int> id;
  std::vector<double> x;
  std::vector<double> v;
  for (int i = 0; i < places.position_size(); i += 2) {
    id.push_back(i / 2 + 1);
    x.insert(x.end(), {places.position(i), places.position(i + 1), 0.0});
    v.insert(v.end(), {0.0, -model.speed, 0.0});
  }
  const std::vector<int> type(id.size(), 1);
  lammps_create_atoms(session.handle(), static_cast<int>(id.size()), id.data(), type.data(), x.data(), v.data(),
                      nullptr, 0);
  say("set type 1 diameter %.17g", model.diameter);
  say("set type 1 density/disc %.17g", model.mass / (3.14159265358979323846 * radius * radius));
  say("pair_style gran/hooke/history %.17g %.17g %.17g 0 %.17g 0", pair.normal_stiffness, pair.tangential_stiffness,
      pair.damping_rate, pair.friction);
  say("pair_coeff * *");
  say("neighbor %.17g bin", model.diameter);
  say("timestep %.17g", dt);
  say("fix motion all nve/sphere disc");
  say("fix ground all wall/gran hooke/history %.17g %.17g %.17g 0 %.17g 0 yplane 0 NULL", wall.normal_stiffness,
      wall.tangential_stiffness, wall.damping_rate, wall.friction);
  say("run 0 post no");
  std::vector<Vec2> found{momentum(session)};
  for (int n = 1; n <= steps; ++n) {
    say("run 1 pre no post no");
    found.push_back(momentum(session));
  }
  return found;
}

// Both add up the same forces in another order. They differ by round-off, which collisions multiply: by ten in about
// every eighty steps at a solid fraction of 0.2 (3e-6 after 1000 steps), far less at the 0.05 of this test (1e-8).
constexpr double round_off = 1e-13;
constexpr double round_off_after_many_collisions = 1e-6;
constexpr std::size_t few_collisions = 250;

TEST(DemWallGran, ImpulseOfEveryStepAgrees) {
  const wire::Setup setup = flat();
  const double dt = model_of(setup).preferred_step;
  const ScriptedLink ours = run_slug(setup, start_of(dt, steps));
  const std::vector<Vec2> theirs = plain_lammps(setup, ours.snapshots.front(), dt);
  const double scale = norm(theirs.front());
  Vec2 before;  // impulse of all earlier steps; of this step one half lies before t(n)
  double largest = 0.0;
  for (std::size_t n = 0; n <= steps; ++n) {
    Vec2 now;
    for (int i = 0; i < ours.forces[n].impulse_size(); i += 2) {
      now += Vec2{{ours.forces[n].impulse(i), ours.forces[n].impulse(i + 1)}};
    }
    const double half = n == 0 ? 1.0 : 0.5;  // at n = 0 only half a step was handed over
    const Vec2 on_slug = -1.0 * (before + half * now);
    EXPECT_NEAR(norm(theirs[n] - theirs[0] - on_slug) / scale, 0.0,
                n <= few_collisions ? round_off : round_off_after_many_collisions)
        << n;
    largest = std::max(largest, norm(on_slug) / scale);
    before += now;
  }
  EXPECT_GT(largest, 0.1);  // a good part of the slug has arrived
}

}  // namespace
}  // namespace grainstep::dem
