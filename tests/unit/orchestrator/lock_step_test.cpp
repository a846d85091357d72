#include "orchestrator/session/lock_step.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "hand_played_steps.hpp"
#include "patience.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

INSTANTIATE_TEST_SUITE_P(, HandPlayed, ::testing::Values(Path::hub, Path::shared, Path::direct), name_of_path);

/// Copies of what went between the sides: who did not wait for whom does not show.
class HandPlayedInTurn : public HandPlayed {};
INSTANTIATE_TEST_SUITE_P(, HandPlayedInTurn, ::testing::Values(Path::hub, Path::shared), name_of_path);

class HandPlayedCopies : public HandPlayed {};
INSTANTIATE_TEST_SUITE_P(, HandPlayedCopies, ::testing::Values(Path::direct), name_of_path);

TEST_P(HandPlayedInTurn, PassesForcesOnUnchanged) {
  impactor_.data().send(forces(0, -0.1));
  EXPECT_THAT(run(0.2), HasSubstr("peer: structure: said nothing for"));
  const wire::Frame* frame = structure_.data().receive(transport::Clock::now());
  ASSERT_NE(frame, nullptr);
  wire::Forces seen;
  structure_.data().take(*frame, seen, 0);
  EXPECT_EQ(seen.SerializeAsString(), forces(0, -0.1).SerializeAsString());
}

TEST_P(HandPlayed, NamesTheSideThatIsSilent) { EXPECT_THAT(run(0.1), HasSubstr("peer: impactor: said nothing for")); }

TEST_P(HandPlayed, RefusesAWindowThatIsNotNext) {
  impactor_.data().send(forces(1));
  EXPECT_THAT(run(), HasSubstr("expected Forces of window 0, got Forces of window 1"));
}

TEST_P(HandPlayedInTurn, RefusesForcesThatDidNotWaitForTheSurface) {
  impactor_.data().send(forces(0));
  impactor_.data().send(forces(1));
  EXPECT_THAT(run(), HasSubstr("peer: impactor: message 2: expected no Forces before the Kinematics of window 1"));
}

TEST_P(HandPlayedInTurn, RefusesKinematicsNobodyAskedFor) {
  structure_.data().send(kinematics(1));
  EXPECT_THAT(run(), HasSubstr("peer: structure: message 1: expected no Kinematics before the next Forces"));
}

TEST_P(HandPlayed, RefusesAMessageOfTheWrongSize) {
  auto wrong = forces(0);
  wrong.add_impulse(0.0);
  impactor_.data().send(wrong);
  EXPECT_THAT(run(), HasSubstr("peer: impactor: Forces of window 0 holds 5 values, the surface has 4"));
}

TEST_P(HandPlayed, RefusesAVelocityThatIsNotTheMotion) {
  auto half = kinematics(1);  // the last of two steps, instead of the mean of both
  half.set_position(3, -2e-3);
  half.set_velocity(3, -3.0);
  impactor_.data().send(forces(0));
  structure_.data().send(half);
  EXPECT_THAT(run(), HasSubstr("peer: structure: Kinematics of window 1: coordinate 2 of node 1 moved by -0.002 m, but "
                               "the velocity sent with it times the window makes -0.003 m"));
}

TEST_P(HandPlayed, TakesTheMeanVelocityOfTheMotion) {
  auto mean = kinematics(1);
  mean.set_position(3, -2e-3);
  mean.set_velocity(3, -2.0);
  impactor_.data().send(forces(0));
  structure_.data().send(mean);
  EXPECT_THAT(run(0.2), HasSubstr("peer: impactor: said nothing for"));
}

// docs/theory/step.md: 1% is refused. What round-off leaves of the mean over many steps is not.
TEST_P(HandPlayed, AVelocityMayBeOffTheMotionByRoundOffOnly) {
  auto off = kinematics(1);
  off.set_position(3, -2e-3);
  off.set_velocity(3, -2.0 * (1.0 + 1e-2));
  impactor_.data().send(forces(0));
  structure_.data().send(off);
  EXPECT_THAT(run(), HasSubstr("coordinate 2 of node 1 moved by"));
}

TEST_P(HandPlayed, AHundredthOfAPercentIsRefusedToo) {
  auto off = kinematics(1);
  off.set_position(3, -2e-3);
  off.set_velocity(3, -2.0 * (1.0 + 1e-4));
  impactor_.data().send(forces(0));
  structure_.data().send(off);
  EXPECT_THAT(run(), HasSubstr("coordinate 2 of node 1 moved by"));
}

TEST_P(HandPlayed, TheMotionOfTheSecondWindowIsCountedFromTheFirst) {
  auto first = kinematics(1);
  first.set_position(3, -2e-3);
  first.set_velocity(3, -2.0);
  auto second = kinematics(2);
  second.set_position(3, -4e-3 * (1.0 + 1e-9));
  second.set_velocity(3, -2.0);
  impactor_.data().send(forces(0));
  structure_.data().send(first);
  impactor_.data().send(forces(1));
  structure_.data().send(second);
  EXPECT_THAT(run(0.2), HasSubstr("peer: impactor: said nothing for"));
}

// The very number, without waiting for it: a test that measured the wait would fail on a busy machine.
TEST_P(HandPlayed, TheSideThatIsWaitedForHasItsSecondsFromItsLastWord) {
  constexpr double silence = 20.0;
  const transport::Clock::duration patience = std::chrono::seconds(20);
  const LockStep steps(hub_, witness_, start_, silence, listener_.get());
  EXPECT_EQ(steps.deadline(), hub_.impactor().heard + patience);
  hub_.structure().heard += std::chrono::hours(1);
  EXPECT_EQ(steps.deadline(), hub_.impactor().heard + patience);
}

TEST_P(HandPlayed, NumbersThatAreNotFiniteEndTheRun) {
  impactor_.data().send(forces(0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_THAT(run(), HasSubstr("numerical: impactor: Forces of window 0: value 0 is nan"));
}

TEST_P(HandPlayed, ASurfaceThatIsNowhereEndsTheRun) {
  auto nowhere = kinematics(1);
  nowhere.set_position(1, std::numeric_limits<double>::infinity());
  impactor_.data().send(forces(0));
  structure_.data().send(nowhere);
  EXPECT_THAT(run(), HasSubstr("numerical: structure: position in Kinematics of window 1: value 1 is inf"));
}

TEST_P(HandPlayed, ASurfaceOfNoSpeedEndsTheRun) {
  auto nowhere = kinematics(1);
  nowhere.set_velocity(2, std::numeric_limits<double>::quiet_NaN());
  impactor_.data().send(forces(0));
  structure_.data().send(nowhere);
  EXPECT_THAT(run(), HasSubstr("numerical: structure: velocity in Kinematics of window 1: value 2 is nan"));
}

TEST_P(HandPlayed, AReportThatIsNoNumberEndsTheRun) {
  impactor_.data().send(forces(0));
  wire::Report report;
  report.mutable_energy()->set_plastic(std::numeric_limits<double>::quiet_NaN());
  structure_.messages_->send(report);
  EXPECT_THAT(run(), HasSubstr("numerical: structure: report of window 0: energy.plastic = nan"));
}

TEST_P(HandPlayed, ALostPeerIsNamedAndWhatItSaidBeforeIsTaken) {
  impactor_.data().send(forces(0));
  impactor_.far_.reset();
  EXPECT_THAT(run(), HasSubstr("peer: impactor: "));
  EXPECT_EQ(witness_.forces_.size(), 1U);
}

// The structure fails and goes while Forces for it are on their way: the loss is noticed when they are sent.
TEST_P(HandPlayed, WhyAPeerWentIsHeardEvenWhenItsGoingIsNoticedFirst) {
  structure_.messages_->send(report(0));
  wire::Error error;
  error.set_kind(wire::Error::NUMERICAL);
  error.set_text("an element is inside out");
  structure_.messages_->send(error);
  structure_.far_.reset();
  impactor_.data().send(forces(0));
  EXPECT_EQ(run(), "numerical: structure: an element is inside out");
  EXPECT_EQ(witness_.structure_.size(), 1U) << "its report of that window was lost";
}

TEST_P(HandPlayed, DamagedBytesArePeerErrors) {
  const std::vector<std::byte> noise(40, std::byte{7});
  impactor_.data().channel().send(noise);
  EXPECT_THAT(run(), HasSubstr("peer: impactor: message 1: expected a frame"));
}

TEST_P(HandPlayed, ReportsOfAnotherWindowThanDueAreRefused) {
  wire::Report report;
  report.set_window(3);
  impactor_.messages_->send(report);
  EXPECT_THAT(run(), HasSubstr("expected Report of window 0, got Report of window 3"));
}

// On the short path Forces and Report go different ways.
TEST_P(HandPlayed, WhatIsReportedOfAWindowComesAfterItsForces) {
  impactor_.data().send(forces(0));
  impactor_.messages_->send(report(0));
  EXPECT_THAT(run(0.2), HasSubstr("peer: structure: said nothing for"));
  EXPECT_EQ(witness_.order_, "forces report ");
}

// The sides are still to be stopped and heard: what they wrongly said on the short path is told once.
TEST_P(HandPlayed, WhatComesAfterTheEndOnTheShortPathEndsNothingMore) {
  if (GetParam() != Path::shared) return;
  LockStep steps(hub_, witness_, start_, grainstep::testing::patience_s, listener_.get());
  impactor_.data().send(forces(0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_THROW(steps.run(), NumericalError);
  impactor_.data().send(forces(7));
  structure_.messages_->send(report(0));
  int heard = 0;
  const auto hear = [&heard](Peer&, const wire::Frame&) { ++heard; };
  EXPECT_NO_THROW(hub_.run(
      hear, [&heard] { return heard == 1; }, Hub::within(grainstep::testing::patience_s)));
}

TEST_P(HandPlayedCopies, AreNotPassedOn) {
  impactor_.data().send(forces(0));
  EXPECT_THAT(run(0.2), HasSubstr("peer: structure: said nothing for"));
  EXPECT_EQ(structure_.data().receive(transport::Clock::now()), nullptr);
}

// One side's copies are here before those of the other that it waited for.
TEST_P(HandPlayedCopies, WaitForTheirTurn) {
  start_.set_windows(2);
  start_.set_report_every(2);
  structure_.data().send(kinematics(1));
  structure_.messages_->send(report(0));
  structure_.data().send(kinematics(2));
  structure_.messages_->send(report(2));
  LockStep steps(hub_, witness_, start_, grainstep::testing::patience_s);
  bool heard_nothing_more = false;
  steps.save_when(
      [&](std::uint64_t /*window*/) {  // asked before the first wait: what the structure said has been looked at
        if (std::exchange(heard_nothing_more, true)) return false;
        for (const std::uint64_t window : {0, 1, 2}) {
          impactor_.data().send(forces(window));
          if (window != 1) impactor_.messages_->send(report(window));
        }
        return false;
      });
  // They could be saved, or nobody would ask.
  for (Peer* peer : {&hub_.impactor(), &hub_.structure()}) peer->hello.add_capabilities("state");
  EXPECT_EQ(text_of_end([&steps] { steps.run(); }), "");
  EXPECT_EQ(witness_.order_, "forces report report forces forces report report ");
}

TEST_P(HandPlayedCopies, OfALaterWindowAreRefused) {
  structure_.data().send(kinematics(2));
  EXPECT_THAT(run(), HasSubstr("peer: structure: message 1: expected no Kinematics before the next Forces"));
}

// What one side said before the other failed counts, whoever was quicker.
TEST_P(HandPlayedCopies, AreHeardAfterAFailure) {
  LockStep steps(hub_, witness_, start_, 0.2);
  EXPECT_THROW(steps.run(), PeerError);
  impactor_.data().send(forces(0));
  const auto hear = [&steps](Peer& peer, const wire::Frame& frame) { steps.late(peer, frame); };
  static_cast<void>(hub_.run(
      hear, [this] { return !witness_.forces_.empty(); }, Hub::within(grainstep::testing::patience_s)));
  EXPECT_EQ(witness_.forces_.size(), 1U);
}

}  // namespace
}  // namespace grainstep::orchestrator
