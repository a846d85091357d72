#include "orchestrator/session/session.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <optional>
#include <sstream>
#include <thread>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "each_path.hpp"
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
  Stage(Path path, fake::Trouble impactor_trouble, fake::Trouble structure_trouble, double impactor_step = 2.5e-4)
      : path_(path), impactor_(std::move(impactor_trouble), impactor_step), structure_(std::move(structure_trouble)) {
    scene_.mutable_output()->set_rows(20);
    scene_.mutable_output()->set_snapshots(5);
    scene_.set_depth(fake::depth);
  }
  explicit Stage(Path path) : Stage(path, {}, {}) {}
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
      impactor_code_ = participant::serve_impactor(
          *far, impactor_, {.shared_memory = impactor_shares_, .direct = connecting(), .errors = &quiet_i});
      far.reset();
    });
    std::thread structure([this, far = std::move(s_far), &quiet_s]() mutable {
      structure_code_ =
          participant::serve_structure(*far, structure_, {.direct = {{.listen = listens_at()}}, .errors = &quiet_s});
      structure_ended_();
      far.reset();
    });
    EventLoop loop;
    Hub hub(*impactor_end_, *structure_end_, loop);
    std::string ending = converse(hub, end);
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
  bool impactor_shares_ = true;
  bool impactor_connects_ = true;
  bool structure_listens_ = true;
  bool one_host_ = true;
  Path taken_ = Path::shortest;
  int impactor_code_ = -1;
  int structure_code_ = -1;
  std::function<void()> structure_ended_ = [] {};  // it has said all that it says

 private:
  [[nodiscard]] std::string listens_at() const {
    return structure_listens_ ? "ipc://" + (directory_.path() / "data").string() : "";
  }
  [[nodiscard]] std::optional<participant::DirectOptions> connecting() const {
    if (!impactor_connects_) return std::nullopt;
    return participant::DirectOptions{};
  }

  std::string converse(Hub& hub, double end) {
    Session session(hub, {.scene = scene_, .hash = 77, .end = end, .path = path_, .one_host = one_host_}, deadlines_);
    try {
      session.introduce();
      plan_ = session.prepare();
      session.run(*plan_, witness_);
      taken_ = session.path();
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

  Path path_;
  TemporaryDirectory directory_;
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

class WholeSession : public ::testing::TestWithParam<Path> {};
INSTANTIATE_TEST_SUITE_P(, WholeSession, ::testing::Values(Path::hub, Path::shared, Path::direct), name_of_path);

TEST_P(WholeSession, RunsToTheEndAndSeesEverything) {
  Stage stage(GetParam());
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
  EXPECT_EQ(stage.taken_, GetParam());
}

// A single one is that of the end: neither side sends one of the start, and nobody waits for it.
TEST_P(WholeSession, TakesAsManySnapshotsAsTheSceneAsksFor) {
  for (const int asked : {0, 1, 2, 7, 51}) {
    Stage stage(GetParam());
    stage.scene().mutable_output()->set_snapshots(static_cast<unsigned>(asked));
    EXPECT_EQ(stage.run(), "");
    EXPECT_EQ(stage.witness_.particles_, asked);
    EXPECT_EQ(stage.witness_.meshes_, asked);
  }
}

TEST_P(WholeSession, TheImpactHappensAndMomentumClosesAtUnequalSteps) {
  Stage stage(GetParam());
  ASSERT_EQ(stage.run(), "");
  const ledger::Balance b = last_balance(stage);
  EXPECT_GT(b.structure.change[1] * b.structure.change[1] + b.structure.support[1] * b.structure.support[1], 1.0);
  EXPECT_LT(b.momentum_error, 1e-13);
}

TEST_P(WholeSession, NothingIsInFlightAtEqualSteps) {
  Stage stage(GetParam(), {}, {}, 1e-3);
  ASSERT_EQ(stage.run(), "");
  ASSERT_TRUE(stage.plan_->equal_steps());
  const ledger::Balance b = last_balance(stage);
  EXPECT_LT(std::abs(b.in_flight[1]), 1e-14);
  EXPECT_LT(b.momentum_error, 1e-13);
}

TEST_P(WholeSession, StructureSubstepsCloseToo) {
  Stage stage(GetParam(), {}, {}, 2e-3);
  ASSERT_EQ(stage.run(), "");
  EXPECT_EQ(stage.plan_->structure_steps, 2U);
  EXPECT_LT(last_balance(stage).momentum_error, 1e-13);
}

TEST_P(WholeSession, TwoRunsAreTheSameBitForBit) {
  Stage one(GetParam());
  Stage two(GetParam());
  ASSERT_EQ(one.run(), "");
  ASSERT_EQ(two.run(), "");
  for (std::size_t i = 0; i < one.witness_.forces_.size(); ++i) {
    EXPECT_EQ(one.witness_.forces_[i].SerializeAsString(), two.witness_.forces_[i].SerializeAsString());
  }
}

TEST_P(WholeSession, BadInputOfAParticipantEndsBothSides) {
  Stage stage(GetParam(), {}, {.window = 3, .act = [] { throw InputError("no such layer"); }});
  EXPECT_EQ(stage.run(), "input: structure: no such layer");
  EXPECT_EQ(stage.structure_code_, 2);
  EXPECT_EQ(stage.impactor_code_, 0) << "it was told to stop, and did";
}

TEST_P(WholeSession, NumericalFailureOfAParticipantEndsBothSides) {
  Stage stage(GetParam(), {.window = 7, .act = [] { throw NumericalError("a particle passed through"); }}, {});
  EXPECT_EQ(stage.run(), "numerical: impactor: a particle passed through");
  EXPECT_EQ(stage.structure_code_, 0);
}

// The impactor reports window 6 only when the structure has failed in it: quicker or slower, the row is kept.
TEST_P(WholeSession, WhatTheOtherSideReportedBeforeAFailureIsKept) {
  std::promise<void> failed;
  Stage stage(GetParam(), {.window = 6, .report = [&] { failed.get_future().wait(); }},
              {.window = 6, .act = [] { throw NumericalError("an element is inside out"); }});
  stage.structure_ended_ = [&] { failed.set_value(); };
  EXPECT_EQ(stage.run(), "numerical: structure: an element is inside out");
  EXPECT_EQ(stage.witness_.impactor_.back().window(), 6U);
}

TEST_P(WholeSession, AFailureThatIsNobodysInputIsThePeers) {
  Stage stage(GetParam(), {.window = 7, .act = [] { throw std::logic_error("oops"); }}, {});
  EXPECT_THAT(stage.run(), HasSubstr("peer: impactor: "));
  EXPECT_EQ(stage.witness_.forces_.size(), 7U) << "what came before is kept";
}

TEST_P(WholeSession, RefusesFixedStepsAfterTheModelsAreKnown) {
  Stage stage(GetParam());
  stage.scene().mutable_steps()->mutable_structure()->set_seconds(0.1);
  EXPECT_THAT(stage.run(), HasSubstr("input: steps.structure"));
}

TEST(SessionPath, IsTheShortestThatBothCanTake) {
  const auto taken = [](bool one_host, bool shares, bool connects, bool listens) {
    Stage stage(Path::shortest);
    stage.one_host_ = one_host;
    stage.impactor_shares_ = shares;
    stage.impactor_connects_ = connects;
    stage.structure_listens_ = listens;
    EXPECT_EQ(stage.run(), "");
    return stage.taken_;
  };
  EXPECT_EQ(taken(true, true, true, true), Path::shared);
  EXPECT_EQ(taken(false, true, true, true), Path::direct);
  EXPECT_EQ(taken(true, false, true, true), Path::direct);
  EXPECT_EQ(taken(true, false, false, true), Path::hub);
  EXPECT_EQ(taken(true, false, true, false), Path::hub);
}

TEST(SessionPath, IsRefusedWhereItWasAskedForAndOneSideCannot) {
  Stage shared(Path::shared);
  shared.impactor_shares_ = false;
  EXPECT_THAT(shared.run(),
              HasSubstr("input: --path shared: the impactor (ball) cannot share memory with the other side"));
  Stage deaf(Path::direct);
  deaf.structure_listens_ = false;
  EXPECT_THAT(deaf.run(), HasSubstr("input: --path direct: the structure (spring) does not listen for the impactor"));
  Stage mute(Path::direct);
  mute.impactor_connects_ = false;
  EXPECT_THAT(mute.run(), HasSubstr("input: --path direct: the impactor (ball) cannot connect to the structure"));
}

TEST(SessionPath, AllGiveTheSameBits) {
  Stage hub(Path::hub);
  ASSERT_EQ(hub.run(), "");
  for (const Path path : {Path::shared, Path::direct}) {
    Stage other(path);
    ASSERT_EQ(other.run(), "");
    ASSERT_EQ(hub.witness_.forces_.size(), other.witness_.forces_.size());
    for (std::size_t i = 0; i < hub.witness_.forces_.size(); ++i) {
      EXPECT_EQ(hub.witness_.forces_[i].SerializeAsString(), other.witness_.forces_[i].SerializeAsString());
    }
  }
}

}  // namespace
}  // namespace grainstep::orchestrator
