#include "orchestrator/session.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <optional>
#include <sstream>
#include <thread>

#include "base/error.hpp"
#include "fake_backends.hpp"
#include "hand_played.hpp"
#include "ledger/ledger.hpp"
#include "participant/serve.hpp"
#include "patience.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

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
  Deadlines deadlines_{.connect_s = grainstep::testing::patience_s,
                       .step_s = grainstep::testing::patience_s,
                       .stop_s = grainstep::testing::patience_s};
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
  EXPECT_EQ(w.impactor_.size(), 20U);
  EXPECT_EQ(w.structure_.size(), 20U);
  EXPECT_EQ(w.particles_, 5);
  EXPECT_EQ(w.meshes_, 5);
  EXPECT_EQ(w.finished_, 1);
  EXPECT_EQ(stage.impactor_code_, 0);
  EXPECT_EQ(stage.structure_code_, 0);
}

// A single one is that of the end: neither side sends one of the start, and nobody waits for it.
TEST(Session, TakesAsManySnapshotsAsTheSceneAsksFor) {
  for (const int asked : {0, 1, 2, 7, 51}) {
    Stage stage;
    stage.scene().mutable_output()->set_snapshots(static_cast<unsigned>(asked));
    EXPECT_EQ(stage.run(), "");
    EXPECT_EQ(stage.witness_.particles_, asked);
    EXPECT_EQ(stage.witness_.meshes_, asked);
  }
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

/// Both peers by hand: what they say is there before it is asked for.
class Handshake : public ::testing::Test {
 protected:
  static constexpr std::uint64_t hash = 77;

  Handshake() : hub_(*impactor_.near_, *structure_.near_, loop_) {
    hello_impactor_ = fake::BallImpactor().describe();
    hello_structure_ = fake::SpringStructure().describe();
    wire::Setup setup;
    setup.set_scene_hash(hash);
    ready_impactor_ = fake::BallImpactor().prepare(setup);
    ready_structure_ = fake::SpringStructure().prepare(setup);
    scene_.set_depth(fake::depth);
    scene_.mutable_output()->set_rows(2);
  }

  Session session() { return Session(hub_, {.scene = scene_, .hash = hash, .end = 1.0}, deadlines_); }

  std::string introduction() {
    impactor_.messages_->send(hello_impactor_);
    structure_.messages_->send(hello_structure_);
    return refusal_of([&] { session().introduce(); });
  }

  /// The structure is prepared first: where it is refused, the impactor is not asked.
  std::string preparation_of_structure() {
    structure_.messages_->send(ready_structure_);
    return refusal_of([&] { static_cast<void>(session().prepare()); });
  }

  /// The impactor answers when it is asked.
  std::string preparation() {
    const auto answer = std::async(std::launch::async, [this] {
      const wire::Frame* frame = impactor_.messages_->receive(transport::in(std::chrono::seconds(60)));
      if (frame == nullptr) return;
      impactor_.messages_->take(*frame, for_impactor_);
      impactor_.messages_->send(ready_impactor_);
    });
    return preparation_of_structure();
  }

  static std::string refusal_of(const std::function<void()>& act) {
    try {
      act();
    } catch (const PeerError& error) {
      return error.what();
    }
    return "";
  }

  /// What a peer has been sent next.
  template <class Message>
  static Message told(ByHand& peer) {
    Message message;
    const wire::Frame* frame = peer.messages_->receive(transport::Clock::now());
    EXPECT_NE(frame, nullptr);
    if (frame != nullptr) peer.messages_->take(*frame, message);
    return message;
  }

  ByHand impactor_{"impactor"};
  ByHand structure_{"structure"};
  EventLoop loop_;
  Hub hub_;
  scene::Scene scene_;
  Deadlines deadlines_{.connect_s = 20.0, .step_s = 20.0, .stop_s = 20.0};
  wire::Hello hello_impactor_, hello_structure_;
  wire::Ready ready_impactor_, ready_structure_;
  wire::Setup for_impactor_;
};

TEST_F(Handshake, TakesBothAsTheyShouldBe) {
  EXPECT_EQ(introduction(), "");
  EXPECT_EQ(preparation(), "");
}

TEST_F(Handshake, RefusesTheWrongRole) {
  hello_impactor_ = hello_structure_;
  EXPECT_THAT(introduction(), HasSubstr("impactor: spring: says that it is the STRUCTURE"));
}

TEST_F(Handshake, RefusesAnotherProtocol) {
  hello_structure_.set_protocol(wire::PROTOCOL_VERSION + 1);
  EXPECT_THAT(introduction(),
              HasSubstr("structure: spring: speaks protocol version " + std::to_string(wire::PROTOCOL_VERSION + 1) +
                        ", this program version " + std::to_string(wire::PROTOCOL_VERSION)));
}

TEST_F(Handshake, RefusesAnotherDimension) {
  hello_impactor_.set_dimension(3);
  EXPECT_THAT(introduction(), HasSubstr("impactor: ball: computes in 3 dimensions, the scene has 2"));
}

TEST_F(Handshake, RefusesAModelOfAnotherScene) {
  ready_structure_.set_scene_hash(hash + 1);
  EXPECT_THAT(preparation_of_structure(), HasSubstr("structure: prepared scene 78, this run is of scene 77"));
}

TEST_F(Handshake, RefusesAnImpactorOfAnotherScene) {
  ready_impactor_.set_scene_hash(0);
  EXPECT_THAT(preparation(), HasSubstr("impactor: prepared scene 0, this run is of scene 77"));
}

TEST_F(Handshake, RefusesStepsThatAreNone) {
  ready_structure_.set_preferred_step(0.0);
  EXPECT_THAT(preparation_of_structure(), HasSubstr("both must be above zero"));
}

TEST_F(Handshake, RefusesAPreferredStepBeyondTheStableOne) {
  ready_structure_.set_preferred_step(2e-3);
  EXPECT_THAT(preparation_of_structure(), HasSubstr("prefers a step of 0.002 s, but is stable only up to 0.001 s"));
}

TEST_F(Handshake, TheSetupHoldsTheSceneAndTheStructuresAnswer) {
  scene_.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  scene_.mutable_structure()->set_extent(scene::Structure::EXTENT_HALF);
  scene_.mutable_structure()->set_half_span(0.25);
  scene_.mutable_impactor()->mutable_slug()->set_speed(123.0);
  scene_.mutable_guards()->set_overlap(0.5);
  ready_structure_.set_free_mass(3.5);
  ASSERT_EQ(preparation(), "");
  const auto for_structure = told<wire::Setup>(structure_);
  for (const wire::Setup& setup : {for_structure, for_impactor_}) {
    EXPECT_EQ(setup.protocol(), wire::PROTOCOL_VERSION);
    EXPECT_EQ(setup.scene_hash(), hash);
    EXPECT_EQ(setup.symmetry(), scene::SYMMETRY_PLANE_STRAIN);
    EXPECT_EQ(setup.depth(), fake::depth);
    EXPECT_TRUE(setup.mirror());
  }
  EXPECT_EQ(for_structure.structure().structure().half_span(), 0.25);
  EXPECT_EQ(for_structure.structure().guards().overlap(), 0.5);
  EXPECT_EQ(for_impactor_.impactor().impactor().slug().speed(), 123.0);
  EXPECT_EQ(for_impactor_.impactor().guards().overlap(), 0.5);
  EXPECT_EQ(for_impactor_.impactor().free_mass(), 3.5);
  EXPECT_EQ(for_impactor_.impactor().surface().SerializeAsString(), ready_structure_.surface().SerializeAsString());
}

// A wait and what is said of it are one number: a longer wait would say so.
TEST_F(Handshake, SilenceIsBorneForTheStepDeadline) {
  deadlines_.step_s = 1.0;
  EXPECT_THAT(refusal_of([&] { static_cast<void>(session().prepare()); }),
              HasSubstr("structure: did not prepare its model within 1 s"));
  StepPlan plan;
  plan.windows = 3;
  plan.window = 1e-3;
  Witness witness;
  Session talk = session();
  EXPECT_THAT(refusal_of([&] { talk.run(plan, witness); }), HasSubstr("impactor: said nothing for 1 s at window 0"));
}

TEST(HubDeadline, IsThatManySecondsFromNow) {
  const auto wait = std::chrono::seconds(20);
  const auto before = transport::Clock::now();
  const Hub::Until until = Hub::within(20.0);
  const auto after = transport::Clock::now();
  EXPECT_GE(until(), before + wait);
  EXPECT_LE(until(), after + wait);
  EXPECT_EQ(until(), until());
}

// docs/user/running.md names them.
TEST(HubDeadline, DefaultsAreTheDocumentedOnes) {
  const Deadlines usual;
  EXPECT_EQ(usual.connect_s, 120.0);
  EXPECT_EQ(usual.step_s, 300.0);
  EXPECT_EQ(usual.stop_s, 5.0);
}

}  // namespace
}  // namespace grainstep::orchestrator
