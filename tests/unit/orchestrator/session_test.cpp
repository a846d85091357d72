#include "orchestrator/session.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <optional>
#include <sstream>
#include <thread>
#include <vector>

#include "base/error.hpp"
#include "fake_backends.hpp"
#include "ledger/ledger.hpp"
#include "orchestrator/lock_step.hpp"
#include "participant/serve.hpp"
#include "transport/in_process_channel.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

/// Keeps everything that passes by.
class Witness final : public StepObserver {
 public:
  void forces(const wire::Forces& forces) override { forces_.push_back(forces); }
  void report(wire::Role side, const wire::Report& report) override {
    (side == wire::IMPACTOR ? impactor_ : structure_).push_back(report);
  }
  void snapshot(wire::Role side, wire::Snapshot snapshot) override {
    ++(side == wire::IMPACTOR ? particles_ : meshes_);
    EXPECT_GT(snapshot.position_size(), 0);
  }
  void idle() override {}
  void finish() override { ++finished_; }

  std::vector<wire::Forces> forces_;
  std::vector<wire::Report> impactor_;
  std::vector<wire::Report> structure_;
  int particles_ = 0;
  int meshes_ = 0;
  int finished_ = 0;
};

/// Both fakes in threads, a session in this one.
class Stage {
 public:
  Stage(fake::Trouble impactor_trouble, fake::Trouble structure_trouble, double impactor_step = 2.5e-4)
      : impactor_(std::move(impactor_trouble), impactor_step), structure_(std::move(structure_trouble)) {
    scene_.mutable_output()->set_rows(20);
    scene_.mutable_output()->set_snapshots(5);
    scene_.set_depth(fake::depth);
  }
  Stage() : Stage({}, {}) {}
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage() {
    impactor_end_.reset();
    structure_end_.reset();
  }

  scene::Scene& scene() { return scene_; }

  /// Returns the text of the exception that ended the run; empty: none.
  std::string run(double end = 0.05) {
    auto [i, i_far] = transport::make_in_process_pair({.first = "orchestrator", .second = "impactor"});
    auto [s, s_far] = transport::make_in_process_pair({.first = "orchestrator", .second = "structure"});
    impactor_end_ = std::move(i);
    structure_end_ = std::move(s);
    std::ostringstream quiet_i;
    std::ostringstream quiet_s;
    std::thread impactor([this, far = std::move(i_far), &quiet_i]() mutable {
      impactor_code_ = participant::serve_impactor(*far, impactor_, {.errors = &quiet_i});
      far.reset();
    });
    std::thread structure([this, far = std::move(s_far), &quiet_s]() mutable {
      structure_code_ = participant::serve_structure(*far, structure_, {.errors = &quiet_s});
      structure_ended_();
      far.reset();
    });
    EventLoop loop;
    Hub hub(*impactor_end_, *structure_end_, loop);
    const std::string ending = converse(hub, end);
    impactor_end_.reset();
    structure_end_.reset();
    impactor.join();
    structure.join();
    return ending;
  }

  Witness witness_;
  std::optional<StepPlan> plan_;
  Deadlines deadlines_{.connect_s = 20.0, .step_s = 20.0, .stop_s = 20.0};
  int impactor_code_ = -1;
  int structure_code_ = -1;
  std::function<void()> structure_ended_ = [] {};  // it has said all that it says

 private:
  std::string converse(Hub& hub, double end) {
    Session session(hub, {.scene = scene_, .hash = 77, .end = end}, deadlines_);
    try {
      session.introduce();
      plan_ = session.prepare();
      session.run(*plan_, witness_);
    } catch (const PeerError& error) {
      session.abandon(error.what(), error.peer());
      return std::string("peer: ") + error.what();
    } catch (const NumericalError& error) {
      session.abandon(error.what(), "");
      return std::string("numerical: ") + error.what();
    } catch (const InputError& error) {
      session.abandon(error.what(), "");
      return std::string("input: ") + error.what();
    }
    return "";
  }

  scene::Scene scene_;
  fake::BallImpactor impactor_;
  fake::SpringStructure structure_;
  std::unique_ptr<transport::Channel> impactor_end_;
  std::unique_ptr<transport::Channel> structure_end_;
};

ledger::Balance last_balance(Stage& stage) {
  const Witness& w = stage.witness_;
  ledger::ImpulseSums sums(2);
  for (const wire::Forces& forces : w.forces_) {
    sums.add({forces.impulse().data(), static_cast<std::size_t>(forces.impulse_size())});
  }
  ledger::Ledger ledger(w.impactor_.front(), w.structure_.front(), stage.plan_->impactor_steps == 1);
  return ledger.close(w.impactor_.back(), w.structure_.back(), sums.handed_over());
}

TEST(Session, RunsToTheEndAndSeesEverything) {
  Stage stage;
  EXPECT_EQ(stage.run(), "");
  EXPECT_EQ(stage.plan_->impactor_steps, 4U);
  EXPECT_EQ(stage.plan_->windows, 50U);
  const Witness& w = stage.witness_;
  EXPECT_EQ(w.forces_.size(), 51U);
  EXPECT_EQ(w.impactor_.back().window(), 50U);
  EXPECT_EQ(w.structure_.back().window(), 50U);
  EXPECT_EQ(w.impactor_.size(), w.structure_.size());
  EXPECT_EQ(w.particles_, w.meshes_);
  EXPECT_GE(w.meshes_, 4);
  EXPECT_EQ(w.finished_, 1);
  EXPECT_EQ(stage.impactor_code_, 0);
  EXPECT_EQ(stage.structure_code_, 0);
}

TEST(Session, TheImpactHappensAndMomentumClosesAtUnequalSteps) {
  Stage stage;
  ASSERT_EQ(stage.run(), "");
  const ledger::Balance b = last_balance(stage);
  EXPECT_GT(b.structure.change[1] * b.structure.change[1] + b.structure.support[1] * b.structure.support[1], 1.0);
  EXPECT_LT(b.momentum_error, 1e-13);
}

TEST(Session, NothingIsInFlightAtEqualSteps) {
  Stage stage({}, {}, 1e-3);
  ASSERT_EQ(stage.run(), "");
  ASSERT_TRUE(stage.plan_->equal_steps());
  const ledger::Balance b = last_balance(stage);
  EXPECT_LT(std::abs(b.in_flight[1]), 1e-14);
  EXPECT_LT(b.momentum_error, 1e-13);
}

TEST(Session, StructureSubstepsCloseToo) {
  Stage stage({}, {}, 2e-3);
  ASSERT_EQ(stage.run(), "");
  EXPECT_EQ(stage.plan_->structure_steps, 2U);
  EXPECT_LT(last_balance(stage).momentum_error, 1e-13);
}

TEST(Session, TwoRunsAreTheSameBitForBit) {
  Stage one;
  Stage two;
  ASSERT_EQ(one.run(), "");
  ASSERT_EQ(two.run(), "");
  for (std::size_t i = 0; i < one.witness_.forces_.size(); ++i) {
    EXPECT_EQ(one.witness_.forces_[i].SerializeAsString(), two.witness_.forces_[i].SerializeAsString());
  }
}

TEST(Session, BadInputOfAParticipantEndsBothSides) {
  Stage stage({}, {.window = 3, .act = [] { throw InputError("no such layer"); }});
  EXPECT_EQ(stage.run(), "input: structure: no such layer");
  EXPECT_EQ(stage.structure_code_, 2);
  EXPECT_EQ(stage.impactor_code_, 0) << "it was told to stop, and did";
}

TEST(Session, NumericalFailureOfAParticipantEndsBothSides) {
  Stage stage({.window = 7, .act = [] { throw NumericalError("a particle passed through"); }}, {});
  EXPECT_EQ(stage.run(), "numerical: impactor: a particle passed through");
  EXPECT_EQ(stage.structure_code_, 0);
}

// The impactor reports window 6 only when the structure has failed in it: quicker or slower, the row is kept.
TEST(Session, WhatTheOtherSideReportedBeforeAFailureIsKept) {
  std::promise<void> failed;
  Stage stage({.window = 6, .report = [&] { failed.get_future().wait(); }},
              {.window = 6, .act = [] { throw NumericalError("an element is inside out"); }});
  stage.structure_ended_ = [&] { failed.set_value(); };
  EXPECT_EQ(stage.run(), "numerical: structure: an element is inside out");
  EXPECT_EQ(stage.witness_.impactor_.back().window(), 6U);
}

TEST(Session, AFailureThatIsNobodysInputIsThePeers) {
  Stage stage({.window = 7, .act = [] { throw std::logic_error("oops"); }}, {});
  EXPECT_THAT(stage.run(), HasSubstr("peer: impactor: "));
  EXPECT_EQ(stage.witness_.forces_.size(), 7U) << "what came before is kept";
}

TEST(Session, RefusesFixedStepsAfterTheModelsAreKnown) {
  Stage stage;
  stage.scene().mutable_steps()->mutable_structure()->set_seconds(0.1);
  EXPECT_THAT(stage.run(), HasSubstr("input: steps.structure"));
}

/// A peer that is played by hand.
class ByHand {
 public:
  explicit ByHand(const char* name) {
    std::tie(near_, far_) = transport::make_in_process_pair({.first = "orchestrator", .second = name});
    messages_.emplace(*far_, "orchestrator");
  }
  std::unique_ptr<transport::Channel> near_;
  std::unique_ptr<transport::Channel> far_;
  std::optional<wire::MessageChannel> messages_;
};

class HandPlayed : public ::testing::Test {
 protected:
  HandPlayed() : hub_(*impactor_.near_, *structure_.near_, loop_) {
    for (const double x : {0.0, 0.0, 1.0, 0.0}) hub_.structure().ready.mutable_surface()->add_position(x);
    start_.set_window(1e-3);
    start_.set_windows(10);
    start_.set_report_every(5);
  }
  static wire::Forces forces(std::uint64_t window, double value = -1.0) {
    wire::Forces out;
    out.set_window(window);
    for (int i = 0; i < 4; ++i) out.add_impulse(value);
    return out;
  }
  static wire::Kinematics kinematics(std::uint64_t window) {
    wire::Kinematics out;
    out.set_window(window);
    for (const double x : {0.0, 0.0, 1.0, 0.0}) {
      out.add_position(x);
      out.add_velocity(0.0);
    }
    return out;
  }
  std::string run(double silence_s = 20.0) {
    try {
      LockStep(hub_, witness_, start_, silence_s).run();
    } catch (const PeerError& error) {
      return std::string("peer: ") + error.what();
    } catch (const NumericalError& error) {
      return std::string("numerical: ") + error.what();
    }
    return "";
  }

  ByHand impactor_{"impactor"};
  ByHand structure_{"structure"};
  EventLoop loop_;
  Hub hub_;
  wire::Start start_;
  Witness witness_;
};

TEST_F(HandPlayed, PassesForcesOnUnchanged) {
  impactor_.messages_->send(forces(0, -0.1));
  EXPECT_THAT(run(0.2), HasSubstr("peer: structure: said nothing for"));
  const wire::Frame* frame = structure_.messages_->receive(transport::Clock::now());
  ASSERT_NE(frame, nullptr);
  wire::Forces seen;
  structure_.messages_->take(*frame, seen, 0);
  EXPECT_EQ(seen.SerializeAsString(), forces(0, -0.1).SerializeAsString());
}

TEST_F(HandPlayed, NamesTheSideThatIsSilent) { EXPECT_THAT(run(0.1), HasSubstr("peer: impactor: said nothing for")); }

TEST_F(HandPlayed, RefusesAWindowThatIsNotNext) {
  impactor_.messages_->send(forces(1));
  EXPECT_THAT(run(), HasSubstr("expected Forces of window 0, got Forces of window 1"));
}

TEST_F(HandPlayed, RefusesForcesThatDidNotWaitForTheSurface) {
  impactor_.messages_->send(forces(0));
  impactor_.messages_->send(forces(1));
  EXPECT_THAT(run(), HasSubstr("peer: impactor: message 2: expected no Forces before the Kinematics of window 1"));
}

TEST_F(HandPlayed, RefusesKinematicsNobodyAskedFor) {
  structure_.messages_->send(kinematics(1));
  EXPECT_THAT(run(), HasSubstr("peer: structure: message 1: expected no Kinematics before the next Forces"));
}

TEST_F(HandPlayed, RefusesAMessageOfTheWrongSize) {
  auto wrong = forces(0);
  wrong.add_impulse(0.0);
  impactor_.messages_->send(wrong);
  EXPECT_THAT(run(), HasSubstr("peer: impactor: Forces of window 0 holds 5 values, the surface has 4"));
}

TEST_F(HandPlayed, RefusesAVelocityThatIsNotTheMotion) {
  auto half = kinematics(1);  // the last of two steps, instead of the mean of both
  half.set_position(3, -2e-3);
  half.set_velocity(3, -3.0);
  impactor_.messages_->send(forces(0));
  structure_.messages_->send(half);
  EXPECT_THAT(run(), HasSubstr("peer: structure: Kinematics of window 1: coordinate 2 of node 1 moved by -0.002 m, but "
                               "the velocity sent with it times the window makes -0.003 m"));
}

TEST_F(HandPlayed, TakesTheMeanVelocityOfTheMotion) {
  auto mean = kinematics(1);
  mean.set_position(3, -2e-3);
  mean.set_velocity(3, -2.0);
  impactor_.messages_->send(forces(0));
  structure_.messages_->send(mean);
  EXPECT_THAT(run(0.2), HasSubstr("peer: impactor: said nothing for"));
}

TEST_F(HandPlayed, NumbersThatAreNotFiniteEndTheRun) {
  impactor_.messages_->send(forces(0, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_THAT(run(), HasSubstr("numerical: impactor: Forces of window 0: value 0 is nan"));
}

TEST_F(HandPlayed, ALostPeerIsNamedAndWhatItSaidBeforeIsTaken) {
  impactor_.messages_->send(forces(0));
  impactor_.far_.reset();
  EXPECT_THAT(run(), HasSubstr("peer: impactor: "));
  EXPECT_EQ(witness_.forces_.size(), 1U);
}

// The structure fails and goes while Forces for it are on their way: the loss is noticed when they are sent.
TEST_F(HandPlayed, WhyAPeerWentIsHeardEvenWhenItsGoingIsNoticedFirst) {
  wire::Report report;
  report.set_window(0);
  structure_.messages_->send(report);
  wire::Error error;
  error.set_kind(wire::Error::NUMERICAL);
  error.set_text("an element is inside out");
  structure_.messages_->send(error);
  structure_.far_.reset();
  impactor_.messages_->send(forces(0));
  EXPECT_EQ(run(), "numerical: structure: an element is inside out");
  EXPECT_EQ(witness_.structure_.size(), 1U) << "its report of that window was lost";
}

TEST_F(HandPlayed, DamagedBytesArePeerErrors) {
  const std::vector<std::byte> noise(40, std::byte{7});
  impactor_.far_->send(noise);
  EXPECT_THAT(run(), HasSubstr("peer: impactor: message 1: expected a frame"));
}

TEST_F(HandPlayed, ReportsOfAnotherWindowThanDueAreRefused) {
  wire::Report report;
  report.set_window(3);
  impactor_.messages_->send(report);
  EXPECT_THAT(run(), HasSubstr("expected Report of window 0, got Report of window 3"));
}

TEST(Introduction, NamesWhoNeverCame) {
  ByHand impactor("impactor");
  ByHand structure("structure");
  EventLoop loop;
  Hub hub(*impactor.near_, *structure.near_, loop);
  const scene::Scene scene;
  Session session(hub, {.scene = scene, .hash = 1, .end = 1.0}, {.connect_s = 0.1, .step_s = 0.1, .stop_s = 0.1});
  fake::SpringStructure spring;
  structure.messages_->send(spring.describe());
  try {
    session.introduce();
    FAIL() << "nobody came";
  } catch (const PeerError& error) {
    EXPECT_EQ(error.peer(), "impactor");
    EXPECT_THAT(error.what(), HasSubstr("did not connect within"));
  }
}

TEST(Introduction, RefusesTheWrongRole) {
  ByHand impactor("impactor");
  ByHand structure("structure");
  EventLoop loop;
  Hub hub(*impactor.near_, *structure.near_, loop);
  const scene::Scene scene;
  Session session(hub, {.scene = scene, .hash = 1, .end = 1.0}, {.connect_s = 20, .step_s = 0.1, .stop_s = 0.1});
  fake::SpringStructure spring;
  impactor.messages_->send(spring.describe());
  EXPECT_THROW(session.introduce(), PeerError);
}

}  // namespace
}  // namespace grainstep::orchestrator
