// Single spheres on rings and on the planes of their slice, through the real engine, against closed forms.
#include <gtest/gtest.h>

#include "slice_rig.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

constexpr double radius = 0.5e-3;
constexpr double slice = 30.0 * degree;
constexpr double middle = 0.5 * slice;
constexpr double speed = 10.0;
constexpr Vec3 up{{0.0, 1.0, 0.0}};

wire::Setup setup_of(double restitution, double friction) {
  wire::Setup setup = slice_setup(slice);
  slug_of(setup).mutable_particle()->set_restitution(restitution);
  slug_of(setup).mutable_particle()->set_friction(friction);
  slug_of(setup).mutable_surface_contact()->set_lever_arm(scene::SurfaceContact::LEVER_ARM_RADIUS);
  set_rings(setup, 0.5, 100);
  return setup;
}

TEST(Sphere, MassAndSliceAreThoseOfTheFullCircle) {
  const SlugModel model = model_of(setup_of(0.7, 0.7));
  EXPECT_NEAR(model.mass, 2700.0 * std::numbers::pi / 6.0 * 1e-9, 1e-15);
  const double slug = std::numbers::pi * 0.02 * 0.02 * 0.02 * 0.2 * 2700.0;
  EXPECT_NEAR(model.whole() * model.mass * static_cast<double>(model.particles), slug,
              0.5 * model.whole() * model.mass);
}

// 2/5 m R^2, and 1/2 m R^2 of a cylinder: what the ledger counts is what LAMMPS turns.
TEST(Sphere, TheLedgerCountsTheEnergyOfItsSpin) {
  constexpr double spin = 3e4;  // 1/s
  for (const bool sphere : {true, false}) {
    wire::Setup setup = sphere ? setup_of(0.7, 0.7) : reference_setup();
    if (!sphere) set_flat_surface(setup, 0.5, 100);
    const SlugModel model = model_of(setup);
    const Vec3 place = sphere ? 0.05 * outward(middle) + 0.01 * up : 0.01 * up;
    const ScriptedLink link = run(setup, start_of(model.preferred_step, 1), {{place, -speed * up, spin}});
    const double inertia = (sphere ? 0.4 : 0.5) * model.mass * radius * radius;
    const double expected = model.whole() * 0.5 * (model.mass * speed * speed + inertia * spin * spin);
    for (const wire::Report& report : link.reports) EXPECT_NEAR(report.energy().kinetic() / expected, 1.0, 1e-12);
  }
}

// The mean over the phase of entry is the scene's e, as for discs (tests/verification/dem/normal_impact.cpp).
TEST(Sphere, ReturnsTheRestitutionFromARing) {
  constexpr int phases = 110;
  for (const double e : {0.3, 0.7, 0.95}) {
    const wire::Setup setup = setup_of(e, 0.0);
    const double dt = model_of(setup).contact_time / 10.0;
    std::vector<PlacedParticle> spheres;
    for (int k = 0; k < phases; ++k) {
      const double gap = speed * dt * (k + 0.5) / phases;
      spheres.push_back({(0.01 + 0.003 * k) * outward(middle) + (radius + gap) * up, -speed * up, 0.0});
    }
    const ScriptedLink link = run(setup, start_of(dt, 60), spheres);
    double mean = 0.0;
    for (int k = 0; k < phases; ++k) mean += sphere_of(link.snapshots.back(), k).velocity[1] / speed / phases;
    EXPECT_NEAR(mean, e, 1e-3);  // 110 phases against the 400 of the calibration
  }
}

/// Spheres that meet flat rings obliquely, along several directions: e = 1, fine steps.
struct Oblique {
  double friction, sliding;  // speed along the surface, m/s
  double kept, spin;         // expected: speed along the surface over `sliding`, spin times radius over `sliding`
};

void check_oblique(const Oblique& expected) {
  const wire::Setup setup = setup_of(1.0, expected.friction);
  const double dt = model_of(setup).contact_time / 400.0;
  std::vector<PlacedParticle> spheres;
  const std::vector<double> directions{0.0, 45.0, 90.0, 200.0};
  std::vector<Vec3> along;
  for (const double direction : directions) {
    along.push_back(outward(direction * degree));
    const double r = 0.05 + 0.1 * static_cast<double>(along.size());
    spheres.push_back(
        {r * outward(middle) + (radius + 0.5 * speed * dt) * up, expected.sliding * along.back() - speed * up, 0.0});
  }
  const ScriptedLink link = run(setup, start_of(dt, 700), spheres);
  constexpr double of_the_step = 0.01;  // first order in dt/t_e
  for (int k = 0; k < static_cast<int>(along.size()); ++k) {
    const Sphere after = sphere_of(link.snapshots.back(), k);
    const Vec3& way = along[static_cast<std::size_t>(k)];
    EXPECT_NEAR(after.velocity[1] / speed, 1.0, of_the_step);
    EXPECT_NEAR(dot(after.velocity, way) / expected.sliding, expected.kept, of_the_step);
    EXPECT_NEAR(dot(after.velocity, cross(up, way)) / expected.sliding, 0.0, of_the_step);
    EXPECT_NEAR(radius * dot(after.spin, cross(up, way)) / expected.sliding, expected.spin, of_the_step);
    EXPECT_NEAR(radius * (norm(after.spin) - std::abs(dot(after.spin, cross(up, way)))) / expected.sliding, 0.0,
                of_the_step);
  }
}

// mu (1 + e) v_n is lost while sliding lasts, and turns the sphere with 5/(2 R) of it.
TEST(Sphere, SlidesAlongEveryDirection) { check_oblique({0.1, 9.0, 1.0 - 2.0 / 9.0, 2.5 * 2.0 / 9.0}); }

// Without sliding the skin's slip oscillates with Ks (1/m + R^2/I) = 3.5 Ks/m; at Ks/Kn = 2/7 it has just turned round
// when the contact ends: 4/7 of the speed is lost, and the sphere leaves with 10/7 of it as spin.
TEST(Sphere, SticksAndTurnsRound) { check_oblique({1e3, 3.0, 3.0 / 7.0, 10.0 / 7.0}); }

constexpr double steepness = 30.0 * degree;

/// A frictionless, elastic sphere that falls on the inside of a cone; the cone may move along its axis.
struct ConeRun {
  double around = 0.0;  // m/s, along the circumference
  double rise = 0.0;    // m/s, of the cone
};

Vec3 cone_normal() { return -std::sin(steepness) * outward(middle) + std::cos(steepness) * up; }

ScriptedLink fall_on_cone(const ConeRun& what) {
  wire::Setup setup = setup_of(1.0, 0.0);
  set_rings(setup, 0.5, 100, std::tan(steepness));
  const double dt = model_of(setup).contact_time / 100.0;
  const Vec3 circumferential{{-std::sin(middle), 0.0, std::cos(middle)}};
  const Vec3 ground = 0.052 * outward(middle) + 0.052 * std::tan(steepness) * up;
  const PlacedParticle sphere{ground + (radius + 0.5 * speed * dt) * cone_normal(),
                              -speed * cone_normal() + what.around * circumferential + what.rise * up, 0.0};
  const wire::Start start = start_of(dt, 200);
  return run(setup, start, {sphere}, [=](std::uint64_t n, const Vec2& x) {
    return x + Vec2{{0.0, what.rise * dt * static_cast<double>(n)}};
  });
}

constexpr double second_order = 1e-3;

TEST(SphereOnACone, ReturnsAlongTheNormalAndGivesTheRingsItsMomentum) {
  const ScriptedLink link = fall_on_cone({});
  const Vec3 velocity = sphere_of(link.snapshots.back(), 0).velocity;
  const Vec3 expected = speed * cone_normal();
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(velocity[c] / speed, expected[c] / speed, second_order);
  const SlugModel model = model_of(slice_setup(slice));
  Vec2 given;
  for (const wire::Forces& forces : link.forces) {
    for (int i = 0; i < forces.impulse_size(); i += 2) given += Vec2{{forces.impulse(i), forces.impulse(i + 1)}};
  }
  const double scale = 2.0 * speed * model.mass * 12.0;  // twelve slices are the circle
  EXPECT_NEAR(given[0] / scale, std::sin(steepness), second_order);
  EXPECT_NEAR(given[1] / scale, -std::cos(steepness), second_order);
  const wire::Momentum& momentum = link.reports.back().momentum();
  EXPECT_NEAR(momentum.interface_impulse(0) / -given[0], 1.0, 1e-12);
  EXPECT_NEAR(momentum.interface_impulse(1) / -given[1], 1.0, 1e-12);
}

TEST(SphereOnACone, OnlyTheRelativeVelocityMatters) {
  const double rise = 7.0;
  const ScriptedLink still = fall_on_cone({});
  const ScriptedLink moving = fall_on_cone({.rise = rise});
  const Vec3 expected = sphere_of(still.snapshots.back(), 0).velocity + rise * up;
  const Vec3 velocity = sphere_of(moving.snapshots.back(), 0).velocity;
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(velocity[c] / speed, expected[c] / speed, 1e-9);
  const wire::Energy& before = moving.reports.front().energy();
  const wire::Energy& after = moving.reports.back().energy();
  EXPECT_NEAR((after.kinetic() - before.kinetic()) / after.interface_work(), 1.0, second_order);
}

// The force lies in the half plane through axis and centre: it has no moment about the axis.
TEST(SphereOnACone, KeepsItsMomentOfMomentumAboutTheAxis) {
  const ScriptedLink link = fall_on_cone({.around = 5.0});
  const auto moment = [](const Sphere& s) { return s.position[2] * s.velocity[0] - s.position[0] * s.velocity[2]; };
  const double before = moment(sphere_of(link.snapshots.front(), 0));
  const double after = moment(sphere_of(link.snapshots.back(), 0));
  EXPECT_NEAR(after / before, 1.0, 1e-12);
  EXPECT_NEAR(norm(sphere_of(link.snapshots.back(), 0).velocity) / std::hypot(speed, 5.0), 1.0, second_order);
}

TEST(SlicePlane, ReturnsTheRestitutionWithoutFriction) {
  const wire::Setup setup = setup_of(0.7, 0.7);
  const double dt = model_of(setup).contact_time / 400.0;
  const Vec3 inward[] = {{{0.0, 0.0, 1.0}}, {{std::sin(slice), 0.0, -std::cos(slice)}}};
  const Vec3 at[] = {0.05 * outward(0.0), 0.05 * outward(slice)};
  const Vec3 along[] = {3.0 * outward(0.0) + 2.0 * up, 3.0 * outward(slice) + 2.0 * up};
  std::vector<PlacedParticle> spheres;
  for (std::size_t k = 0; k < 2; ++k) {
    const double distance = radius + 0.5 * speed * dt;
    spheres.push_back({at[k] + 0.01 * up + distance * inward[k], along[k] - speed * inward[k], 0.0});
  }
  const ScriptedLink link = run(setup, start_of(dt, 1000), spheres);
  for (std::size_t k = 0; k < 2; ++k) {
    const Sphere after = sphere_of(link.snapshots.back(), static_cast<int>(k));
    EXPECT_NEAR(dot(after.velocity, inward[k]) / speed, 0.7, 2e-3);  // first order in dt/t_e
    const Vec3 rest = after.velocity - dot(after.velocity, inward[k]) * inward[k];
    EXPECT_NEAR(norm(rest - along[k]), 0.0, 1e-12 * speed);
    EXPECT_EQ(norm(after.spin), 0.0);
  }
  const wire::Report& first = link.reports.front();
  const wire::Report& last = link.reports.back();
  const double change = last.momentum().linear(0) - first.momentum().linear(0);
  EXPECT_NEAR(last.momentum().support_impulse(0) / change, 1.0, 1e-12);
  EXPECT_NEAR((last.energy().kinetic() + last.energy().damping()) / first.energy().kinetic(), 1.0, 1e-4);
}

/// The whole slug on rings that give way and become a cone.
ScriptedLink impact() {
  wire::Setup setup = slice_setup(slice);
  set_rings(setup, 0.2, 60);
  const SlugModel model = model_of(setup);
  const double dt = model.contact_time / 10.0;
  const auto windows = static_cast<std::uint64_t>(0.5 * model.height / model.speed / dt);
  wire::Start start = start_of(dt, windows);
  start.set_report_every(static_cast<double>(windows / 10));
  return run_slug(setup, start, [=](std::uint64_t n, const Vec2& x) {
    const double t = static_cast<double>(n) / static_cast<double>(windows);
    return x + Vec2{{0.0, -t * t * (2e-3 - 0.02 * x[0])}};
  });
}

TEST(SliceLedger, Closes) {
  const ScriptedLink link = impact();
  const SlugModel model = model_of(slice_setup(slice));
  const wire::Report& first = link.reports.front();
  const double mass = model.whole() * model.mass * static_cast<double>(model.particles);
  EXPECT_NEAR(first.energy().kinetic() / (0.5 * mass * 400.0 * 400.0), 1.0, 1e-12);
  EXPECT_NEAR(first.momentum().linear(1) / (-mass * 400.0), 1.0, 1e-12);
  const auto total = [](const wire::Energy& e) {
    return e.kinetic() + e.elastic() + e.damping() + e.friction() - e.interface_work() - e.support_work();
  };
  for (const wire::Report& report : link.reports) {
    const wire::Momentum& now = report.momentum();
    for (int c = 0; c < 2; ++c) {
      const double open =
          now.linear(c) - first.momentum().linear(c) - now.interface_impulse(c) - now.support_impulse(c);
      EXPECT_NEAR(open / (mass * 400.0), 0.0, 1e-12) << "window " << report.window();
    }
    EXPECT_NEAR(total(report.energy()) / total(first.energy()), 1.0, 0.01) << "window " << report.window();
  }
  const wire::Report& last = link.reports.back();
  EXPECT_GT(last.momentum().interface_impulse(1), 0.2 * mass * 400.0);
  EXPECT_GT(last.energy().friction(), 0.0);
  EXPECT_GT(observable(last, "circumferential_share"), 0.0);
  EXPECT_LT(observable(last, "circumferential_share"), 0.2);
}

TEST(SliceLedger, RingsGetWhatTheParticlesGive) {
  const ScriptedLink link = impact();
  Vec2 given;
  for (const wire::Forces& forces : link.forces) {
    const double weight = &forces == &link.forces.back() ? 0.5 : 1.0;  // half of the last step lies behind t(n)
    for (int i = 0; i < forces.impulse_size(); i += 2) {
      given += weight * Vec2{{forces.impulse(i), forces.impulse(i + 1)}};
    }
  }
  const wire::Momentum& last = link.reports.back().momentum();
  EXPECT_NEAR(last.interface_impulse(0) / -given[0], 1.0, 1e-10);
  EXPECT_NEAR(last.interface_impulse(1) / -given[1], 1.0, 1e-10);
}

}  // namespace
}  // namespace grainstep::dem
