#include "ledger/ledger.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace grainstep::ledger {
namespace {

struct State {
  double momentum;
  double received;
  double support = 0.0;
};

wire::Report report_of(const State& x2) {
  wire::Report out;
  for (const double value : {0.0, x2.momentum}) out.mutable_momentum()->add_linear(value);
  for (const double value : {0.0, x2.received}) out.mutable_momentum()->add_interface_impulse(value);
  for (const double value : {0.0, x2.support}) out.mutable_momentum()->add_support_impulse(value);
  return out;
}

ImpulseSums sums_of(std::initializer_list<double> x2_of_windows) {
  ImpulseSums sums(2);
  for (const double x2 : x2_of_windows) {
    sums.add(std::array{0.0, x2});
  }
  return sums;
}

TEST(ImpulseSums, KeepWhatCameBeforeApartFromTheLatest) {
  ImpulseSums sums(2);
  sums.add(std::array{1.0, -2.0, 0.5, -1.0});
  sums.add(std::array{0.0, -4.0, 0.0, 3.0});
  const HandedOver& h = sums.handed_over();
  EXPECT_DOUBLE_EQ(h.before[0], 1.5);
  EXPECT_DOUBLE_EQ(h.before[1], -3.0);
  EXPECT_DOUBLE_EQ(h.latest[1], -1.0);
  EXPECT_DOUBLE_EQ(h.total()[1], -4.0);
  EXPECT_DOUBLE_EQ(h.peak, 7.0);  // |-4| + |3|, not |-1|
}

// Equal steps: windows give -1 (half a step) and -3; at t(1) both sides have taken up the first and half of the second.
TEST(Ledger, EqualStepsCloseWithNothingInFlight) {
  Ledger ledger(report_of({-10.0, 0.0}), report_of({0.0, 0.0}), true);
  const auto sums = sums_of({-1.0, -3.0});
  const Balance b = ledger.close(report_of({-7.5, 2.5}), report_of({-2.5, -2.5}), sums.handed_over());
  EXPECT_EQ(b.in_flight[1], 0.0);
  EXPECT_EQ(b.momentum_error, 0.0);
  EXPECT_DOUBLE_EQ(b.impactor.change[1], 2.5);
  EXPECT_DOUBLE_EQ(b.momentum_reference, 10.0);
}

// The structure says only what it has received: 2.5, of which the messages carried 1 + 1.5. What it would have to show
// for it is nobody's to judge.
TEST(Ledger, OfASideWithoutBooksOnlyTheInterfaceIsJudged) {
  Ledger ledger(report_of({-10.0, 0.0}), report_of({0.0, 0.0}), true, {}, {.structure = wire::INTERFACE});
  const auto sums = sums_of({-1.0, -3.0});
  const Balance good = ledger.close(report_of({-7.5, 2.5}), report_of({0.0, -2.5}), sums.handed_over());
  EXPECT_EQ(good.momentum_error, 0.0);
  EXPECT_TRUE(std::isnan(good.structure.error));
  EXPECT_TRUE(std::isnan(good.energy_change));
  EXPECT_TRUE(std::isnan(good.structure_energy));
  EXPECT_EQ(good.impactor.error, 0.0);
  // It cannot have received more than was sent, and the other side is judged as ever.
  EXPECT_DOUBLE_EQ(ledger.close(report_of({-7.5, 2.5}), report_of({0.0, -5.0}), sums.handed_over()).momentum_error,
                   0.1);
  EXPECT_DOUBLE_EQ(ledger.close(report_of({-6.5, 2.5}), report_of({0.0, -2.5}), sums.handed_over()).momentum_error,
                   0.1);
}

TEST(Ledger, OfASideWithoutBooksTheWorkAtTheInterfaceIsJudged) {
  Ledger ledger(report_of({0.0, 0.0}), report_of({0.0, 0.0}), true, {},
                {.impactor = wire::INTERFACE, .structure = wire::INTERFACE});
  wire::Report impactor = report_of({0.0, 1.0});
  wire::Report structure = report_of({0.0, -1.0});
  impactor.mutable_energy()->set_interface_work(-4.0);
  structure.mutable_energy()->set_interface_work(3.0);
  HandedOver handed = sums_of({-1.0, 0.0}).handed_over();
  handed.acting = 10;
  const Balance b = ledger.close(impactor, structure, handed);
  EXPECT_DOUBLE_EQ(b.energy_reference, 4.0);
  EXPECT_DOUBLE_EQ(b.energy_drift, 0.25);
}

TEST(Ledger, WhatIsNoNumberIsNotPassedOver) {
  Ledger ledger(report_of({-10.0, 0.0}), report_of({0.0, 0.0}), true);
  wire::Report impactor = report_of({-10.0, 0.0});
  impactor.mutable_energy()->set_kinetic(std::numeric_limits<double>::infinity());
  impactor.mutable_energy()->set_support_work(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(ledger.close(impactor, report_of({0.0, 0.0}), sums_of({0.0}).handed_over()).energy_drift));
}

TEST(Ledger, SupportsAreNotAnError) {
  Ledger ledger(report_of({-10.0, 0.0}), report_of({0.0, 0.0}), true);
  const auto sums = sums_of({-1.0, -3.0});
  const Balance b = ledger.close(report_of({-7.5, 2.5}), report_of({-1.5, -2.5, 1.0}), sums.handed_over());
  EXPECT_EQ(b.momentum_error, 0.0);
}

// Two steps per window: the impactor has given all but half its last step (-4 + 0.5), the structure half a window.
TEST(Ledger, UnequalStepsShowWhatIsInFlightAndDoNotCountItAsError) {
  Ledger ledger(report_of({-10.0, 0.0}), report_of({0.0, 0.0}), false);
  const auto sums = sums_of({-1.0, -3.0});
  const Balance b = ledger.close(report_of({-6.5, 3.5}), report_of({-2.5, -2.5}), sums.handed_over());
  EXPECT_DOUBLE_EQ(b.in_flight[1], -1.0);
  EXPECT_EQ(b.momentum_error, 0.0);
}

TEST(Ledger, MoreThanTheMessagesCarriedCannotHideInFlight) {
  Ledger ledger(report_of({-10.0, 0.0}), report_of({0.0, 0.0}), false);
  const auto sums = sums_of({-1.0, -3.0});
  const Balance b = ledger.close(report_of({-6.5, 3.5}), report_of({-0.5, -0.5}), sums.handed_over());
  EXPECT_DOUBLE_EQ(b.interface_momentum, 0.05);  // -0.5 lies 0.5 outside [-4, -1]
  EXPECT_DOUBLE_EQ(b.momentum_error, 0.05);
}

TEST(Ledger, LostMomentumIsAnErrorOfItsSide) {
  Ledger ledger(report_of({-10.0, 0.0}), report_of({0.0, 0.0}), true);
  const auto sums = sums_of({-1.0, -3.0});
  const Balance b = ledger.close(report_of({-7.5, 2.5}), report_of({-2.4, -2.5}), sums.handed_over());
  EXPECT_NEAR(b.structure.error, 0.01, 1e-15);
  EXPECT_EQ(b.impactor.error, 0.0);
  EXPECT_NEAR(b.momentum_error, 0.01, 1e-15);
}

TEST(Ledger, EnergyCountsEveryPartOfBothSides) {
  auto start_i = report_of({-10.0, 0.0});
  auto start_s = report_of({0.0, 0.0});
  start_i.mutable_energy()->set_kinetic(100.0);
  auto now_i = start_i;
  auto now_s = start_s;
  now_i.mutable_energy()->set_kinetic(40.0);
  now_i.mutable_energy()->set_elastic(3.0);
  now_i.mutable_energy()->set_damping(10.0);
  now_i.mutable_energy()->set_friction(7.0);
  now_i.mutable_energy()->set_interface_work(-40.0);
  now_s.mutable_energy()->set_kinetic(20.0);
  now_s.mutable_energy()->set_elastic(5.0);
  now_s.mutable_energy()->set_plastic(12.0);
  now_s.mutable_energy()->set_viscous(2.0);
  now_s.mutable_energy()->set_support_work(-1.0);
  now_s.mutable_energy()->set_interface_work(40.0);
  const Balance b = Ledger(start_i, start_s, true).close(now_i, now_s, sums_of({0.0}).handed_over());
  EXPECT_DOUBLE_EQ(b.energy, 100.0);
  EXPECT_EQ(b.energy_change, 0.0);
  EXPECT_EQ(b.impactor_energy, 0.0);
  EXPECT_EQ(b.structure_energy, 0.0);
  EXPECT_EQ(b.interface_mismatch, 0.0);  // without the observable: 40 - 40
  EXPECT_EQ(b.energy_drift, 0.0);
  auto* seen = now_i.add_observable();
  seen->set_name("work_on_surface");
  seen->set_value(39.5);
  const Balance with = Ledger(start_i, start_s, true).close(now_i, now_s, sums_of({0.0}).handed_over());
  EXPECT_DOUBLE_EQ(with.interface_mismatch, -0.5);
  EXPECT_DOUBLE_EQ(with.energy_drift, 0.005);
}

// The impactor lost 3 J in its own steps, the interface made 2 of them up: the whole looks better than any part.
TEST(Ledger, GainAtTheInterfaceDoesNotHideLossInASide) {
  auto start_i = report_of({-10.0, 0.0});
  auto start_s = report_of({0.0, 0.0});
  start_i.mutable_energy()->set_kinetic(100.0);
  auto now_i = start_i;
  auto now_s = start_s;
  now_i.mutable_energy()->set_kinetic(57.0);
  now_i.mutable_energy()->set_interface_work(-40.0);
  now_s.mutable_energy()->set_kinetic(42.5);
  now_s.mutable_energy()->set_interface_work(42.0);
  const Balance b = Ledger(start_i, start_s, false).close(now_i, now_s, sums_of({0.0}).handed_over());
  EXPECT_DOUBLE_EQ(b.energy_change, -0.005);
  EXPECT_DOUBLE_EQ(b.impactor_energy, -0.03);
  EXPECT_DOUBLE_EQ(b.structure_energy, 0.005);
  EXPECT_DOUBLE_EQ(b.interface_mismatch, -2.0);
  EXPECT_DOUBLE_EQ(b.energy_drift, 0.03);
}

// A prescribed load: nothing moves at the start, and what it gives to the structure comes from outside.
wire::Report load_report(double impulse, double work) {
  wire::Report out = report_of({0.0, impulse, -impulse});
  out.mutable_energy()->set_interface_work(-work);
  out.mutable_energy()->set_support_work(work);
  return out;
}

wire::Report moved_report(double momentum, double work, double energy) {
  wire::Report out = report_of({momentum, momentum});
  out.mutable_energy()->set_kinetic(energy);
  out.mutable_energy()->set_interface_work(work);
  return out;
}

TEST(Ledger, WithNothingAtTheStartTheReferenceIsWhatWasHandedOverAtMost) {
  Ledger ledger(load_report(0.0, 0.0), report_of({0.0, 0.0}), true);
  // 4 N s and 10 J have been handed over for long; 0.1 J of them cannot be found in the structure.
  HandedOver given = sums_of({-3.0, -2.0}).handed_over();
  EXPECT_EQ(given.acting, 2U);
  given.acting = 50;
  Balance b = ledger.close(load_report(4.0, 10.0), moved_report(-4.0, 10.0, 9.9), given);
  EXPECT_EQ(b.energy_reference, 10.0);
  EXPECT_EQ(b.momentum_reference, 5.0);
  EXPECT_EQ(b.momentum_error, 0.0);
  EXPECT_NEAR(b.energy_drift, 0.01, 1e-15);
  EXPECT_NEAR(b.structure_energy, -0.01, 1e-15);
  EXPECT_EQ(b.impactor_energy, 0.0);
  // All of it comes back; the reference stays, so that a small rest is not compared with nothing.
  b = ledger.close(load_report(0.0, 0.0), moved_report(0.0, 0.0, 0.1), given);
  EXPECT_EQ(b.energy_reference, 10.0);
  EXPECT_NEAR(b.energy_drift, 0.01, 1e-15);
}

// An unstable interface hands over more than there ever was: measured by itself it would look small.
TEST(Ledger, WorkThatTheSidesMakeOfEachOtherIsNoReference) {
  wire::Report impactor = report_of({10.0, 0.0});
  impactor.mutable_energy()->set_kinetic(2.0);
  Ledger ledger(impactor, report_of({0.0, 0.0}), true);
  HandedOver given = sums_of({-4.0}).handed_over();
  given.acting = 50;
  impactor.mutable_energy()->set_interface_work(-100.0);
  const Balance b = ledger.close(impactor, moved_report(-4.0, 110.0, 110.0), given);
  EXPECT_EQ(b.energy_reference, 2.0);
  EXPECT_NEAR(b.energy_drift, 55.0, 1e-12);
}

TEST(Ledger, ALoadThatClaimsOtherWorkThanTheStructureReceivedIsSeen) {
  Ledger ledger(load_report(0.0, 0.0), report_of({0.0, 0.0}), true);
  HandedOver given = sums_of({-4.0}).handed_over();
  given.acting = 50;
  const Balance b = ledger.close(load_report(4.0, 11.0), moved_report(-4.0, 10.0, 10.0), given);
  EXPECT_NEAR(b.interface_mismatch, 1.0, 1e-15);
  EXPECT_NEAR(b.energy_drift, 1.0 / 11.0, 1e-15);
}

TEST(Ledger, AWorkThatHasJustBegunCountsAsIfItHadGoneOnForTenWindows) {
  Ledger ledger(load_report(0.0, 0.0), report_of({0.0, 0.0}), false);
  HandedOver given = sums_of({-4.0}).handed_over();
  for (const auto& [windows, drift] : {std::pair{1U, 0.02}, {4U, 0.08}, {10U, 0.2}, {99U, 0.2}}) {
    given.acting = windows;
    const Balance b = ledger.close(load_report(4.0, 10.0), moved_report(-4.0, 10.0, 8.0), given);
    EXPECT_NEAR(b.energy_drift, drift, 1e-15) << windows;
  }
}

// Two halves that swing against each other have no momentum together; what their mass could have is the reference.
TEST(Ledger, OppositeMomentaAreNotComparedWithTheirSum) {
  const auto at_rest = report_of({0.0, 0.0});
  auto swinging = report_of({1e-18, 0.0});
  swinging.mutable_energy()->set_kinetic(50.0);
  Ledger ledger(at_rest, swinging, true, {.impactor = 0.0, .structure = 4.0});
  const Balance b = ledger.close(at_rest, swinging, sums_of({0.0}).handed_over());
  EXPECT_DOUBLE_EQ(b.momentum_reference, 20.0);  // sqrt(2 * 4 kg * 50 J)
}

TEST(Ledger, WhatComesFromNothingIsAllThereIs) {
  const auto rest = report_of({0.0, 0.0});
  auto moving = report_of({1e-20, 0.0});
  moving.mutable_energy()->set_kinetic(1e-30);
  const Balance b = Ledger(rest, rest, true).close(rest, moving, sums_of({0.0}).handed_over());
  EXPECT_EQ(b.momentum_error, 1.0);
  EXPECT_EQ(b.energy_drift, 1.0);
}

TEST(Ledger, ARunAtRestHasNoScaleAndNoDivisionByZero) {
  const auto rest = report_of({0.0, 0.0});
  const Balance b = Ledger(rest, rest, true).close(rest, rest, sums_of({0.0}).handed_over());
  EXPECT_EQ(b.momentum_error, 0.0);
  EXPECT_EQ(b.energy_drift, 0.0);
}

}  // namespace
}  // namespace grainstep::ledger
