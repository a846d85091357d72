#include "ledger/guards.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "ledger/message_numbers.hpp"

namespace grainstep::ledger {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

scene::Guards guards() {
  scene::Guards out;
  out.set_energy_drift(0.03);
  out.set_momentum_error(1e-9);
  out.set_overlap(0.5);
  out.set_element_quality(0.01);
  return out;
}

Guarded good() {
  Guarded out;
  out.balance.energy_drift = 0.02;
  out.balance.momentum_error = 1e-13;
  out.overlap = 0.2;
  out.element_quality = 0.4;
  return out;
}

TEST(Guards, LetAGoodStatePass) { EXPECT_FALSE(violation(guards(), good())); }

TEST(Guards, NameTheLimitAndBothValues) {
  auto state = good();
  state.balance.energy_drift = 0.0625;
  EXPECT_THAT(violation(guards(), state).value(),
              AllOf(HasSubstr("guards.energy_drift"), HasSubstr("0.0625"), HasSubstr("0.03"), HasSubstr("smaller")));
}

TEST(Guards, MomentumOverlapAndQualityEachStopTheRun) {
  auto momentum = good();
  momentum.balance.momentum_error = 1e-6;
  EXPECT_THAT(violation(guards(), momentum).value(), HasSubstr("guards.momentum_error"));
  auto overlap = good();
  overlap.overlap = 0.6;
  EXPECT_THAT(violation(guards(), overlap).value(), HasSubstr("guards.overlap"));
  auto quality = good();
  quality.element_quality = 0.005;
  EXPECT_THAT(violation(guards(), quality).value(), HasSubstr("guards.element_quality"));
}

TEST(Guards, SidesThatDoNotReportAQuantityAreNotJudgedByIt) {
  auto state = good();
  state.overlap.reset();
  state.element_quality.reset();
  EXPECT_FALSE(violation(guards(), state));
}

TEST(Guards, NotANumberIsNeverWithinALimit) {
  auto state = good();
  state.balance.energy_drift = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(violation(guards(), state));
}

TEST(MessageNumbers, FindTheFieldAndItsValue) {
  wire::Report report;
  report.mutable_energy()->set_kinetic(1.0);
  EXPECT_FALSE(first_not_finite(report));
  auto* observable = report.add_observable();
  observable->set_value(std::numeric_limits<double>::infinity());
  EXPECT_EQ(first_not_finite(report).value(), "observable[0].value = inf");
}

TEST(MessageNumbers, FindTheElementOfAList) {
  wire::Forces forces;
  forces.add_impulse(0.0);
  forces.add_impulse(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(first_not_finite(forces).value(), "impulse[1] = nan");
}

// What one would change of a foam is not what one would change of particles.
TEST(Guards, AdviseByTheImpactor) {
  auto state = good();
  state.impactor = scene::Impactor::TYPE_FOAM;
  state.overlap = 0.75;
  EXPECT_THAT(
      violation(guards(), state).value(),
      AllOf(HasSubstr("guards.overlap"), HasSubstr("impactor.foam.contact_stiffness"), Not(HasSubstr("article"))));
  state.balance.energy_drift = 0.0625;
  EXPECT_THAT(violation(guards(), state).value(), AllOf(HasSubstr("guards.energy_drift"), HasSubstr("shock_width")));
}

}  // namespace
}  // namespace grainstep::ledger
