// States of both sides, put together while the lock step goes on.
#include "orchestrator/session/saving.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "hand_played_steps.hpp"
#include "wire/state_parts.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

class HandPlayedSaving : public HandPlayed {
 protected:
  HandPlayedSaving() {
    for (Peer* peer : {&hub_.impactor(), &hub_.structure()}) peer->hello.add_capabilities("state");
    start_.set_windows(1);
    start_.set_report_every(1);
  }
  static wire::Forces marked(std::uint64_t window) {
    wire::Forces out = forces(window);
    out.set_save(true);
    return out;
  }
  static wire::State part(std::uint32_t chunk, const std::string& bytes, std::uint64_t window = 0) {
    wire::State out;
    out.set_window(window);
    out.set_chunk(chunk);
    out.set_data(bytes);
    out.set_checksum(checksum_of(bytes));
    return out;
  }
  static wire::Saved saved(std::uint32_t chunks, std::uint64_t window = 0) {
    wire::Saved out;
    out.set_window(window);
    out.set_chunks(chunks);
    return out;
  }
  /// As the sender has it.
  static std::uint64_t checksum_of(const std::string& bytes) {
    ByHand sender("sender");
    wire::MessageChannel far(*sender.near_, "sender");
    wire::send_state(*sender.messages_, 0, bytes);
    wire::State seen;
    far.take(*far.receive(transport::Clock::now()), seen);
    return seen.checksum();
  }
  /// `then` is called when the orchestrator wants states for the first time.
  std::string run_saving(const std::function<void()>& then, double silence_s = grainstep::testing::patience_s) {
    LockStep steps(hub_, witness_, start_, silence_s, listener_.get());
    bool wanted = false;
    steps.save_when([&](std::uint64_t /*window*/) {
      if (std::exchange(wanted, true)) return false;
      then();
      return true;
    });
    return text_of_end([&steps] { steps.run(); });
  }
  /// What the run says where the impactor says this of its state.
  template <typename Message>
  std::string end_after(const Message& wrong) {
    return run_saving([&] {
      impactor_.data().send(marked(0));
      impactor_.messages_->send(report(0));
      impactor_.messages_->send(wrong);
    });
  }
  [[nodiscard]] bool was_asked() {
    const wire::Frame* frame = impactor_.messages_->receive(transport::Clock::now());
    return frame != nullptr && frame->kind == wire::Envelope::kSave;
  }
};
INSTANTIATE_TEST_SUITE_P(, HandPlayedSaving, ::testing::Values(Path::hub, Path::shared, Path::direct), name_of_path);

TEST_P(HandPlayedSaving, ForcesOfTheNextWindowWaitForBothStates) {
  const auto said = [this] {
    impactor_.data().send(marked(0));
    impactor_.messages_->send(report(0));
    impactor_.messages_->send(part(0, "sand"));
    impactor_.messages_->send(saved(1));
    impactor_.data().send(forces(1));
    impactor_.messages_->send(report(1));
    structure_.data().send(kinematics(1));
    structure_.messages_->send(report(0));
    structure_.messages_->send(part(0, "ste"));
    structure_.messages_->send(part(1, "el"));
    structure_.messages_->send(saved(2));
    structure_.messages_->send(report(1));
  };
  EXPECT_EQ(run_saving(said), "");
  EXPECT_TRUE(was_asked());
  EXPECT_EQ(witness_.order_, "forces report report checkpoint forces report report ");
  ASSERT_EQ(witness_.checkpoints_.size(), 1U);
  EXPECT_EQ(witness_.checkpoints_[0].window, 0U);
  EXPECT_EQ(witness_.checkpoints_[0].impactor, "sand");
  EXPECT_EQ(witness_.checkpoints_[0].structure, "steel");
  EXPECT_EQ(witness_.checkpoints_[0].surface, (std::vector<double>{0.0, 0.0, 1.0, 0.0}));
}

// On the short path the structure has read Forces that are not heard here yet, because a report is.
TEST_P(HandPlayedSaving, AStateMayOvertakeTheForcesThatAskForIt) {
  if (GetParam() != Path::shared) return;
  start_.set_windows(2);
  start_.set_report_every(2);
  LockStep steps(hub_, witness_, start_, grainstep::testing::patience_s, listener_.get());
  int turn = 0;
  steps.save_when([&](std::uint64_t /*window*/) {
    if (++turn == 1) {
      impactor_.data().send(forces(0));
      impactor_.data().send(marked(1));
      structure_.data().send(kinematics(1));
      structure_.data().send(kinematics(2));
      structure_.messages_->send(report(0));
      structure_.messages_->send(part(0, "steel", 1));
      structure_.messages_->send(saved(1, 1));
      structure_.messages_->send(report(2));
      return true;
    }
    if (turn == 2) {
      impactor_.messages_->send(report(0));
      impactor_.messages_->send(part(0, "sand", 1));
      impactor_.messages_->send(saved(1, 1));
      impactor_.data().send(forces(2));
      impactor_.messages_->send(report(2));
    }
    return false;
  });
  EXPECT_EQ(text_of_end([&steps] { steps.run(); }), "");
  ASSERT_EQ(witness_.checkpoints_.size(), 1U);
  EXPECT_EQ(witness_.checkpoints_[0].structure, "steel");
}

TEST_P(HandPlayedSaving, IsNotAskedForWhereOneSideCannot) {
  hub_.structure().hello.clear_capabilities();
  EXPECT_THAT(run_saving([] {}, 0.2), HasSubstr("impactor: said nothing"));
  EXPECT_FALSE(was_asked());
}

TEST_P(HandPlayedSaving, NobodyAskedForIsRefused) {
  impactor_.data().send(marked(0));
  EXPECT_THAT(run(), HasSubstr("peer: impactor: Forces of window 0 ask for states that nobody wants"));
}

TEST_P(HandPlayedSaving, WhoeverOwesAStateIsNamed) {
  const auto said = [this] {
    impactor_.data().send(marked(0));
    impactor_.messages_->send(report(0));
    impactor_.messages_->send(part(0, "sand"));
    impactor_.messages_->send(saved(1));
    structure_.data().send(kinematics(1));
    structure_.messages_->send(report(0));
  };
  EXPECT_THAT(run_saving(said, 0.2), HasSubstr("peer: structure: said nothing for"));
  EXPECT_TRUE(witness_.checkpoints_.empty());
}

TEST_P(HandPlayedSaving, ADamagedPartIsRefused) {
  wire::State damaged = part(0, "sand");
  damaged.set_data("sane");
  EXPECT_THAT(end_after(damaged), HasSubstr("part 0 is damaged"));
}

TEST_P(HandPlayedSaving, APartThatIsNotNextIsRefused) {
  EXPECT_THAT(end_after(part(1, "sand")), HasSubstr("expected part 0, got part 1"));
}

TEST_P(HandPlayedSaving, AWrongCountIsRefused) {
  EXPECT_THAT(end_after(saved(1)), HasSubstr("counts 1 parts, 0 have come"));
}

}  // namespace
}  // namespace grainstep::orchestrator
