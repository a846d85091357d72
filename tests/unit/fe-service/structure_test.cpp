// The backend as the orchestrator drives it.
#include "fe-service/structure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../support/fe_scenes.hpp"
#include "base/error.hpp"
#include "fe-service/rigid.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fe {
namespace {

using test::beam;
using test::setup_of;
using testing::HasSubstr;

const scene::Structure kSmallBeam = beam(scene::Layer::MATERIAL_DH36, 0.1, 0.02, 3);

wire::Start start_of(double window, std::uint32_t steps) {
  wire::Start start;
  start.set_window(window);
  start.set_windows(1000);
  start.set_impactor_steps(1);
  start.set_structure_steps(steps);
  return start;
}

/// Uneven impulses on every surface node, N s, for a while.
wire::Forces forces_of(std::uint64_t window, int nodes, double sign = 1.0) {
  wire::Forces forces;
  forces.set_window(window);
  for (int k = 0; k < nodes; ++k) {
    const bool on = window < 60;
    forces.add_impulse(on ? 1e-6 * std::sin(0.7 * k + 0.1 * static_cast<double>(window)) : 0.0);
    forces.add_impulse(on ? -sign * 4e-6 * (1.0 + std::cos(1.1 * k)) : 0.0);
  }
  return forces;
}

double value_of(const wire::Report& report, const std::string& name) {
  for (const wire::Observable& observable : report.observable()) {
    if (observable.name() == name) return observable.value();
  }
  ADD_FAILURE() << name << " is not reported";
  return 0.0;
}

struct Record {
  wire::Ready ready;
  std::vector<wire::Report> reports;
  std::vector<wire::Kinematics> kinematics;
  wire::Snapshot snapshot;
};

/// `sign`: -1 pulls.
Record run(const scene::Structure& scene_part, double window, std::uint32_t steps, std::uint64_t windows,
           double sign = 1.0) {
  Record result;
  Structure structure;
  result.ready = structure.prepare(setup_of(scene_part));
  structure.start(start_of(window, steps));
  const int nodes = result.ready.surface().position_size() / 2;
  for (std::uint64_t n = 0; n <= windows; ++n) {
    wire::Kinematics next;
    structure.advance(forces_of(n, nodes, sign), {.report = true, .snapshot = n == windows}, next);
    result.kinematics.push_back(next);
    structure.report(result.reports.emplace_back());
    if (n == windows) structure.snapshot(result.snapshot);
    structure.complete();
  }
  return result;
}

TEST(Structure, DescribesItselfBeforeItKnowsTheScene) {
  const wire::Hello hello = Structure().describe();
  EXPECT_EQ(hello.role(), wire::STRUCTURE);
  EXPECT_EQ(hello.dimension(0), 2u);
  EXPECT_THAT(hello.capabilities(), testing::IsSupersetOf({"beam", "rigid"}));
}

TEST(Structure, ReadyTellsMassSizeSteps) {
  const wire::Ready ready = Structure().prepare(setup_of(kSmallBeam));
  EXPECT_EQ(ready.scene_hash(), 42u);
  EXPECT_EQ(ready.size(), 4u * 30 * 6);
  EXPECT_NEAR(ready.mass(), 8000.0 * 0.1 * 0.02 * 1e-3, 1e-14);
  EXPECT_LT(ready.preferred_step(), ready.stable_step());
  EXPECT_EQ(ready.surface().facet_size(), 2 * (30 + 6));
}

// Walking along every segment, the structure must lie to the right: tangent turned by +90 degrees points out.
TEST(Structure, NormalsPointOutwards) {
  for (const auto extent : {scene::Structure::EXTENT_HALF, scene::Structure::EXTENT_FULL}) {
    for (const auto type : {scene::Structure::TYPE_BEAM, scene::Structure::TYPE_RIGID}) {
      scene::Structure structure = kSmallBeam;
      structure.set_extent(extent);
      structure.set_type(type);
      const wire::Surface surface = Structure().prepare(setup_of(structure)).surface();
      const double inside_x = extent == scene::Structure::EXTENT_HALF ? 0.05 : 0.0;
      for (int s = 0; s < surface.facet_size(); s += 2) {
        const auto at = [&](int end, int c) {
          return surface.position(static_cast<int>(2 * surface.facet(s + end)) + c);
        };
        const double normal_x = -(at(1, 1) - at(0, 1));
        const double normal_y = at(1, 0) - at(0, 0);
        EXPECT_GT(normal_x * (at(0, 0) - inside_x) + normal_y * (at(0, 1) + 0.01), 0.0) << "segment " << s / 2;
      }
    }
  }
}

class SubstepRatio : public testing::TestWithParam<std::uint32_t> {};

TEST_P(SubstepRatio, MomentumClosesToRoundOffInEveryReport) {
  const double stable = Structure().prepare(setup_of(kSmallBeam)).stable_step();
  const Record result = run(kSmallBeam, 0.9 * stable * GetParam(), GetParam(), 200);
  double scale = 0.0;
  for (const wire::Report& report : result.reports) {
    for (int c = 0; c < 2; ++c) {
      const wire::Momentum& momentum = report.momentum();
      scale = std::max(scale, std::abs(momentum.interface_impulse(c)));
      const double error = momentum.linear(c) - momentum.interface_impulse(c) - momentum.support_impulse(c);
      EXPECT_LE(std::abs(error), 1e-13 * scale) << "window " << report.window();
    }
  }
  // All that was sent has arrived, whatever the ratio.
  double sent = 0.0;
  const int nodes = result.ready.surface().position_size() / 2;
  for (std::uint64_t n = 0; n < 60; ++n) {
    for (int k = 0; k < nodes; ++k) sent += forces_of(n, nodes).impulse(2 * k + 1);
  }
  EXPECT_NEAR(result.reports.back().momentum().interface_impulse(1), sent, 1e-13 * std::abs(sent));
}

TEST_P(SubstepRatio, SurfaceVelocityCarriesTheSurface) {
  const double stable = Structure().prepare(setup_of(kSmallBeam)).stable_step();
  const double window = 0.9 * stable * GetParam();
  const Record result = run(kSmallBeam, window, GetParam(), 20);
  for (std::size_t n = 1; n < result.kinematics.size(); ++n) {
    const wire::Kinematics& before = result.kinematics[n - 1];
    const wire::Kinematics& after = result.kinematics[n];
    for (int i = 0; i < after.position_size(); ++i) {
      EXPECT_NEAR(after.position(i), before.position(i) + window * after.velocity(i), 1e-15);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ratios, SubstepRatio, testing::Values(1u, 2u, 3u));

TEST(Structure, TheFirstReportIsTheStateAtRest) {
  const Record result = run(kSmallBeam, 1e-7, 1, 1);
  EXPECT_EQ(result.reports[0].energy().kinetic(), 0.0);
  EXPECT_EQ(result.reports[0].momentum().interface_impulse(1), 0.0);
  EXPECT_EQ(result.kinematics[0].window(), 1u);
}

// The window asks for steps that are too long: more are taken, and the answer stays that of short steps.
TEST(Structure, TakesMoreStepsWhereStabilityAsksForIt) {
  const double stable = Structure().prepare(setup_of(kSmallBeam)).stable_step();
  const Record asked = run(kSmallBeam, 2.5 * stable, 1, 50);
  const Record given = run(kSmallBeam, 2.5 * stable, 3, 50);
  EXPECT_EQ(asked.reports.back().timing().steps(), given.reports.back().timing().steps());
  EXPECT_EQ(value_of(asked.reports.back(), "deflection"), value_of(given.reports.back(), "deflection"));
}

// A pressure of some 2 GPa on the loaded face flattens the elements below it.
TEST(Structure, TakesMoreStepsAsElementsAreFlattened) {
  Structure structure;
  const wire::Ready ready = structure.prepare(setup_of(kSmallBeam));
  structure.start(start_of(ready.preferred_step(), 1));
  const int nodes = ready.surface().position_size() / 2;
  wire::Report report;
  const double force = 2e9 * 1e-3 * 0.1 / 30;  // N on a node
  for (std::uint64_t n = 0; n < 3000 && report.timing().steps() <= n; ++n) {
    wire::Forces forces;
    forces.set_window(n);
    for (int k = 0; k < nodes; ++k) {
      forces.add_impulse(0.0);
      forces.add_impulse(k < 20 ? -force * ready.preferred_step() : 0.0);
    }
    wire::Kinematics next;
    structure.advance(forces, {.report = true}, next);
    structure.report(report);
    structure.complete();
  }
  EXPECT_GT(report.timing().steps(), report.window());
  EXPECT_LT(value_of(report, "stable_step"), ready.preferred_step() / 0.97);
  EXPECT_GT(value_of(report, "min_element_quality"), 0.5);
}

TEST(Structure, FixedStepBeyondStabilityIsRefusedWithItsPlace) {
  Structure structure;
  const wire::Ready ready = structure.prepare(setup_of(kSmallBeam));
  wire::Start start = start_of(1.2 * ready.stable_step(), 1);
  start.set_structure_fixed(true);
  try {
    structure.start(start);
    FAIL() << "accepted";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("unstable step"));
    EXPECT_THAT(error.what(), HasSubstr("quad (column"));
    EXPECT_THAT(error.what(), HasSubstr("steps.structure"));
  }
}

TEST(Structure, InvertedElementIsNamedWithItsPlace) {
  Structure structure;
  const wire::Ready ready = structure.prepare(setup_of(kSmallBeam));
  structure.start(start_of(ready.preferred_step(), 1));
  const int nodes = ready.surface().position_size() / 2;
  try {
    for (std::uint64_t n = 0; n < 200; ++n) {
      wire::Forces forces;
      forces.set_window(n);
      for (int i = 0; i < 2 * nodes; ++i) forces.add_impulse(i == 2 * 10 + 1 ? -0.1 : 0.0);
      wire::Kinematics next;
      structure.advance(forces, {}, next);
      structure.complete();
    }
    FAIL() << "not noticed";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("element quality"));
    EXPECT_THAT(error.what(), HasSubstr("row 0"));
    EXPECT_THAT(error.what(), testing::AnyOf(HasSubstr("column 9"), HasSubstr("column 10")));
    EXPECT_THAT(error.what(), HasSubstr("guards.element_quality"));
  }
}

TEST(Structure, ForcesOfTheWrongShapeOrValueAreRefused) {
  Structure structure;
  const wire::Ready ready = structure.prepare(setup_of(kSmallBeam));
  structure.start(start_of(ready.preferred_step(), 1));
  wire::Kinematics next;
  EXPECT_THROW(structure.advance(wire::Forces{}, {}, next), PeerError);
  wire::Forces forces = forces_of(0, ready.surface().position_size() / 2);
  forces.set_impulse(5, std::nan(""));
  EXPECT_THROW(structure.advance(forces, {}, next), NumericalError);
}

TEST(Structure, SnapshotHoldsTheMeshAndItsFields) {
  const Record result = run(kSmallBeam, 1e-7, 1, 5);
  const int points = 31 * 7 + 30 * 6;
  const int cells = 4 * 30 * 6;
  EXPECT_EQ(result.snapshot.position_size(), 2 * points);
  EXPECT_EQ(result.snapshot.cell_size(), 3 * cells);
  EXPECT_LT(*std::max_element(result.snapshot.cell().begin(), result.snapshot.cell().end()),
            static_cast<std::uint32_t>(points));
  for (const wire::Field& field : result.snapshot.point_field()) {
    EXPECT_EQ(field.value_size(), static_cast<int>(field.components()) * points) << field.name();
    if (field.name() != "displacement") continue;
    for (const double u : field.value()) EXPECT_LT(std::abs(u), 1e-4);  // five short steps: it has hardly moved
  }
  std::vector<std::string> names;
  for (const wire::Field& field : result.snapshot.cell_field()) {
    EXPECT_EQ(field.value_size(), cells) << field.name();
    names.push_back(field.name());
  }
  EXPECT_THAT(names, testing::ElementsAre("equivalent_plastic_strain", "von_mises_stress", "pressure", "layer"));
}

TEST(Structure, RunsAreRepeatedBitForBit) {
  const Record first = run(kSmallBeam, 1e-7, 1, 100);
  const Record second = run(kSmallBeam, 1e-7, 1, 100);
  for (std::size_t n = 0; n < first.kinematics.size(); ++n) {
    EXPECT_EQ(first.kinematics[n].SerializeAsString(), second.kinematics[n].SerializeAsString());
  }
}

// Suction: the peak is the largest in size, with its sign.
TEST(Structure, PulledItDeflectsTheOtherWay) {
  scene::Structure free = kSmallBeam;
  free.set_type(scene::Structure::TYPE_RIGID);
  free.set_motion(scene::Structure::MOTION_FREE);
  for (const scene::Structure& structure : {kSmallBeam, free}) {
    const wire::Report pulled = run(structure, 1e-7, 1, 120, -1.0).reports.back();
    const wire::Report pressed = run(structure, 1e-7, 1, 120).reports.back();
    EXPECT_LT(value_of(pulled, "peak_deflection"), 0.0);
    EXPECT_GT(value_of(pressed, "peak_deflection"), 0.0);
    EXPECT_NEAR(value_of(pulled, "peak_deflection") / value_of(pressed, "peak_deflection"), -1.0,
                0.1);  // model: not small
    EXPECT_LE(value_of(pulled, "peak_deflection"), value_of(pulled, "deflection"));
    EXPECT_GT(value_of(pulled, "peak_deflection_time"), 0.0);
  }
}

TEST(Rigid, GivesToItsSupportsWhatItReceives) {
  scene::Structure structure = kSmallBeam;
  structure.set_type(scene::Structure::TYPE_RIGID);
  const Record result = run(structure, 1e-6, 1, 100);
  EXPECT_EQ(result.ready.size(), 0u);
  EXPECT_EQ(result.ready.stable_step(), participant::no_step_limit);
  double sent = 0.0;
  for (std::uint64_t n = 0; n < 60; ++n) {
    for (int k = 0; k < 3; ++k) sent += forces_of(n, 3).impulse(2 * k + 1);
  }
  const wire::Momentum& momentum = result.reports.back().momentum();
  EXPECT_NEAR(momentum.interface_impulse(1), sent, 1e-13 * std::abs(sent));
  EXPECT_EQ(momentum.support_impulse(1), -momentum.interface_impulse(1));
  EXPECT_EQ(momentum.linear(1), 0.0);
  EXPECT_EQ(value_of(result.reports.back(), "deflection"), 0.0);
}

}  // namespace
}  // namespace grainstep::fe
