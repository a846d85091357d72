// How the engine behaves as a participant: order, early end, failures, reproducibility.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "dem-service/lammps/impactor.hpp"
#include "engine_rig.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

wire::Setup small_slug() {
  wire::Setup setup = reference_setup();
  setup.set_mirror(true);
  set_flat_surface(setup, 0.2, 60);
  return setup;
}

double step_of(const wire::Setup& setup) { return model_of(setup).preferred_step; }

TEST(Engine, SpeaksOncePerWindowInOrder) {
  const wire::Setup setup = small_slug();
  wire::Start start = start_of(step_of(setup), 50, 3);
  start.set_report_every(20);
  start.set_snapshot_every(25);
  const ScriptedLink link = run_slug(setup, start);
  ASSERT_EQ(link.forces.size(), 51U);
  for (std::size_t n = 0; n < link.forces.size(); ++n) EXPECT_EQ(link.forces[n].window(), n);
  const auto windows = [](const auto& messages) {
    std::vector<std::uint64_t> found;
    found.reserve(messages.size());
    for (const auto& message : messages) found.push_back(message.window());
    return found;
  };
  EXPECT_THAT(windows(link.reports), testing::ElementsAre(0, 20, 40, 50));
  EXPECT_THAT(windows(link.snapshots), testing::ElementsAre(0, 25, 50));
  EXPECT_EQ(link.reports.back().timing().steps(), 150U);
}

TEST(Engine, SnapshotHoldsEveryParticleByIdentity) {
  const wire::Setup setup = small_slug();
  const ScriptedLink link = run_slug(setup, start_of(step_of(setup), 1200));
  const wire::Snapshot& last = link.snapshots.back();
  const auto count = static_cast<int>(model_of(setup).particles);
  EXPECT_EQ(last.position_size(), 2 * count);
  EXPECT_EQ(last.cell_size(), 0);
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(field(last, "identity").value(i), i + 1);
    EXPECT_EQ(field(last, "radius").value(i), 0.5e-3);
  }
  EXPECT_EQ(field(last, "velocity").value_size(), 2 * count);
  EXPECT_EQ(field(last, "angular_velocity").value_size(), count);
}

TEST(Engine, EndsWhenTheOtherSideEnds) {
  const wire::Setup setup = small_slug();
  const wire::Start start = start_of(step_of(setup), 100000);
  ScriptedLink link(setup, start, at_rest());
  link.stop_before = 30;
  SlugEngine engine(alone(), setup);
  engine.run(start, &link);
  EXPECT_EQ(link.forces.back().window(), 30U);
}

class BreakingLink final : public participant::ImpactorLink {
 public:
  const wire::Kinematics* surface(std::uint64_t) override { throw PeerError("orchestrator", "lost"); }
  participant::Due due(std::uint64_t) const override { return {}; }
  void send(const wire::Forces&) override {}
  void send(wire::Report&) override {}
  void send(const wire::Snapshot&) override {}
};

TEST(Engine, PassesOnWhatTheLinkThrows) {
  const wire::Setup setup = small_slug();
  BreakingLink link;
  SlugEngine engine(alone(), setup);
  EXPECT_THROW(engine.run(start_of(step_of(setup), 1000), &link), PeerError);
}

TEST(Engine, RefusesKinematicsOfAnotherSurface) {
  const wire::Setup setup = small_slug();
  wire::Setup other = setup;
  set_flat_surface(other, 0.2, 10);
  const wire::Start start = start_of(step_of(setup), 1000);
  ScriptedLink link(other, start, at_rest());
  SlugEngine engine(alone(), setup);
  EXPECT_THROW(engine.run(start, &link), PeerError);
}

TEST(Engine, AStepFarTooLargeIsANumericalError) {
  wire::Setup setup = small_slug();
  slug_of(setup).mutable_particle()->set_restitution(1.0);  // a dashpot could not be calibrated for such a step
  EXPECT_THROW((void)run_slug(setup, start_of(60.0 * step_of(setup), 500)), NumericalError);
}

TEST(Engine, CannotContinueARun) {
  const wire::Setup setup = small_slug();
  wire::Start start = start_of(step_of(setup), 10);
  start.set_first_window(5);
  EXPECT_THROW((void)run_slug(setup, start), InputError);
}

TEST(Engine, LammpsErrorsBecomeExceptionsWithItsOwnWords) {
  LammpsSession session(alone().communicator, {});
  try {
    session.command("pair_style no/such/style");
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("pair_style no/such/style"));
    EXPECT_THAT(error.what(), testing::HasSubstr("Unrecognized pair style"));
  }
}

std::string everything(const ScriptedLink& link) {
  std::string bytes;
  for (const auto& message : link.forces) bytes += message.SerializeAsString();
  for (const auto& message : link.snapshots) bytes += message.SerializeAsString();
  for (const auto& message : link.reports) bytes += message.energy().SerializeAsString();
  return bytes;
}

TEST(Engine, TheSameRunTwiceIsTheSameBitForBit) {
  const wire::Setup setup = small_slug();
  wire::Start start = start_of(step_of(setup), 1500, 2);
  start.set_report_every(100);
  EXPECT_EQ(everything(run_slug(setup, start)), everything(run_slug(setup, start)));
}

TEST(Engine, LookingDoesNotDisturb) {
  wire::Setup setup = small_slug();
  wire::Start start = start_of(step_of(setup), 1500);
  const ScriptedLink quiet = run_slug(setup, start);
  start.set_report_every(10);
  start.set_snapshot_every(50);
  const ScriptedLink watched = run_slug(setup, start);
  EXPECT_EQ(quiet.snapshots.back().SerializeAsString(), watched.snapshots.back().SerializeAsString());
}

TEST(Impactor, DescribesAndPreparesItself) {
  const wire::Setup setup = small_slug();
  const auto impactor = make_impactor(alone());
  EXPECT_EQ(impactor->describe().role(), wire::IMPACTOR);
  EXPECT_EQ(impactor->describe().dimension(0), 2U);
  const wire::Ready ready = impactor->prepare(setup);
  const SlugModel model = model_of(setup);
  EXPECT_EQ(ready.size(), model.particles);
  EXPECT_DOUBLE_EQ(ready.mass(), model.mass * static_cast<double>(model.particles));
  EXPECT_DOUBLE_EQ(ready.preferred_step(), model.contact_time / 10.0);
  EXPECT_GT(ready.stable_step(), ready.preferred_step());
  EXPECT_GT(ready.memory(), 1'000'000U);
}

TEST(Impactor, TooDenseASlugIsAnInputError) {
  wire::Setup setup = small_slug();
  slug_of(setup).set_relative_density(0.6);
  EXPECT_THROW((void)make_impactor(alone())->prepare(setup), InputError);
}

}  // namespace
}  // namespace grainstep::dem
