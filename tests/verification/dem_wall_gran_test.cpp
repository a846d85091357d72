// A rigid flat surface is LAMMPS's own `fix wall/gran hooke/history`. Same slug, same law on both sides: lever arm of
// one radius, effective mass m, no tension cut-off, the same damping rate, no tangential dashpot.
//
// Collisions multiply a difference by ten in about every eighty steps, so that nothing but identical bits stays small.
// The law does LAMMPS's operations in LAMMPS's order, contact is added to the pair forces where LAMMPS adds it, and the
// box, bins and skin below are the engine's, because the order in which a particle's pairs are summed depends on them.
#include <gtest/gtest.h>

#define LAMMPS_LIB_MPI
#include <lammps/library.h>

#include <algorithm>
#include <cstdio>

#include "../unit/dem-service/engine_rig.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

constexpr int steps = 1000;
constexpr int compared_every = 50;

/// The reference slug (full width, D = 1 mm) on a flat surface.
wire::Setup reference_on_flat() {
  wire::Setup setup = reference_setup();
  scene::Slug& slug = slug_of(setup);
  slug.mutable_surface_contact()->set_lever_arm(scene::SurfaceContact::LEVER_ARM_RADIUS);
  slug.set_half_width(0.1);
  slug.set_height(0.3);
  set_flat_surface(setup, 0.2, 60);
  return setup;
}

/// One particle's motion in the plane.
struct Motion2 {
  Vec2 position, velocity;
  double spin = 0.0;
  friend bool operator==(const Motion2&, const Motion2&) = default;
};

std::vector<Motion2> motion_of(const wire::Snapshot& snapshot) {
  const wire::Field& velocity = field(snapshot, "velocity");
  const wire::Field& spin = field(snapshot, "angular_velocity");
  std::vector<Motion2> all;
  for (int i = 0; i < spin.value_size(); ++i) {
    all.push_back({{{snapshot.position(2 * i), snapshot.position(2 * i + 1)}},
                   {{velocity.value(2 * i), velocity.value(2 * i + 1)}},
                   spin.value(i)});
  }
  return all;
}

/// The slug in plain LAMMPS, from the places of a snapshot.
class PlainLammps {
 public:
  PlainLammps(const wire::Setup& setup, const std::vector<Motion2>& start, double dt)
      : model_(model_of(setup)), session_(alone().communicator, {}) {
    create(start);
    set_laws(calibrated_pair_law(model_, dt), calibrated_surface_law(model_, dt));
    say("timestep %.17g", dt);
    say("run 0 post no");
  }

  void step() { say("run 1 pre no post no"); }

  [[nodiscard]] std::vector<Motion2> motion() {
    const int count = *static_cast<int*>(lammps_extract_global(session_.handle(), "nlocal"));
    const auto* id = atoms<int*>("id");
    auto** x = atoms<double**>("x");
    auto** v = atoms<double**>("v");
    auto** omega = atoms<double**>("omega");
    std::vector<Motion2> all(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      all[static_cast<std::size_t>(id[i] - 1)] = {{{x[i][0], x[i][1]}}, {{v[i][0], v[i][1]}}, omega[i][2]};
    }
    return all;
  }

  [[nodiscard]] Vec2 momentum() {
    Vec2 sum;
    for (const Motion2& particle : motion()) sum += model_.mass * particle.velocity;
    return sum;
  }

 private:
  template <typename... Values>
  void say(const char* format, Values... values) {
    char text[400];
    std::snprintf(text, sizeof text, format, values...);
    session_.command(text);
  }

  template <typename Array>
  [[nodiscard]] Array atoms(const char* name) {
    return static_cast<Array>(lammps_extract_atom(session_.handle(), name));
  }

  void create(const std::vector<Motion2>& start) {
    for (const char* line : {"units si", "atom_style sphere", "dimension 2", "newton on", "boundary m m p",
                             "comm_modify vel yes", "processors * 1 1"}) {
      session_.command(line);
    }
    const double room = 2.0 * model_.diameter;
    Vec2 low = start.front().position;
    Vec2 high = low;
    std::vector<int> id;
    std::vector<double> x;
    std::vector<double> v;
    for (const Motion2& particle : start) {
      id.push_back(static_cast<int>(id.size()) + 1);
      x.insert(x.end(), {particle.position[0], particle.position[1], 0.0});
      v.insert(v.end(), {particle.velocity[0], particle.velocity[1], 0.0});
      for (std::size_t c = 0; c < 2; ++c) {
        low[c] = std::min(low[c], particle.position[c]);
        high[c] = std::max(high[c], particle.position[c]);
      }
    }
    say("region slug block %.17g %.17g %.17g %.17g %.17g %.17g units box", low[0] - room, high[0] + room, low[1] - room,
        high[1] + room, -room / 2.0, room / 2.0);
    say("create_box 1 slug");
    const std::vector<int> type(id.size(), 1);
    lammps_create_atoms(session_.handle(), static_cast<int>(id.size()), id.data(), type.data(), x.data(), v.data(),
                        nullptr, 0);
    std::fill_n(atoms<double*>("radius"), id.size(), model_.diameter / 2.0);
    std::fill_n(atoms<double*>("rmass"), id.size(), model_.mass);
  }

  void set_laws(const ContactLaw& pair, const ContactLaw& wall) {
    say("pair_style gran/hooke/history %.17g %.17g %.17g 0 %.17g 0", pair.normal_stiffness, pair.tangential_stiffness,
        pair.damping_rate, pair.friction);
    say("pair_coeff * *");
    say("neighbor %.17g bin", model_.diameter);
    say("neigh_modify delay 0 every 1 check yes binsize %.17g", 2.0 * model_.diameter);
    say("fix motion all nve/sphere disc");
    say("fix ground all wall/gran hooke/history %.17g %.17g %.17g 0 %.17g 0 yplane 0 NULL", wall.normal_stiffness,
        wall.tangential_stiffness, wall.damping_rate, wall.friction);
  }

  SlugModel model_;
  LammpsSession session_;
};

/// What the slug has received by t(0), t(1), ...
std::vector<Vec2> received(const std::vector<wire::Forces>& forces) {
  std::vector<Vec2> sums;
  Vec2 before;  // impulse of all earlier steps; of this step one half lies before t(n)
  for (const wire::Forces& sent : forces) {
    Vec2 now;
    for (int i = 0; i < sent.impulse_size(); i += 2) now += Vec2{{sent.impulse(i), sent.impulse(i + 1)}};
    const double half = sums.empty() ? 1.0 : 0.5;  // at n = 0 only half a step was handed over
    sums.push_back(-1.0 * (before + half * now));
    before += now;
  }
  return sums;
}

void expect_none(const std::string& quantity, const std::string& unit, double found, double tolerance,
                 const std::string& reason) {
  verification::check({.group = "contact",
                       .name = "flat rigid surface against LAMMPS's own wall",
                       .quantity = quantity,
                       .unit = unit,
                       .reference = "fix wall/gran hooke/history",
                       .origin = "the linked LAMMPS, run on the same slug in the same test",
                       .expected = 0.0,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = reason});
}

TEST(DemWallGran, EveryBitOfEveryParticleAgrees) {
  const wire::Setup setup = reference_on_flat();
  const double dt = model_of(setup).preferred_step;
  wire::Start start = start_of(dt, steps);
  start.set_snapshot_every(compared_every);
  const ScriptedLink ours = run_slug(setup, start);
  const std::vector<Vec2> on_slug = received(ours.forces);
  ASSERT_EQ(on_slug.size(), steps + 1);
  ASSERT_EQ(ours.snapshots.size(), steps / compared_every + 1);

  PlainLammps theirs(setup, motion_of(ours.snapshots.front()), dt);
  const Vec2 momentum = theirs.momentum();
  double worst = 0.0;
  int differing = 0;
  for (std::size_t n = 1; n <= steps; ++n) {
    theirs.step();
    worst = verification::larger(worst, norm(theirs.momentum() - momentum - on_slug[n]) / norm(momentum));
    if (n % compared_every != 0) continue;
    const std::vector<Motion2> mine = motion_of(ours.snapshots[n / compared_every]);
    const std::vector<Motion2> plain = theirs.motion();
    ASSERT_EQ(mine.size(), plain.size());
    for (std::size_t i = 0; i < mine.size(); ++i) differing += mine[i] == plain[i] ? 0 : 1;
  }
  expect_none("largest difference of impulse and momentum, over the slug's, of 1000 steps", "", worst, 1e-13,
              "exact: round-off of adding up particles and steps");
  expect_none("particles that differ in any bit of place, velocity or spin", "particles", differing, 0.0,
              "exact: same operations in the same order");
  EXPECT_GT(norm(on_slug.back()) / norm(momentum), 0.1);  // a good part of the slug has arrived
}

}  // namespace
}  // namespace grainstep::dem
