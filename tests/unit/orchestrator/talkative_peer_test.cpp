/// @file A peer that never stops talking: it must not keep the orchestrator from coming to an end.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "hand_played.hpp"
#include "orchestrator/session/session.hpp"
#include "patience.hpp"

namespace grainstep::orchestrator {
namespace {

/// Sends Forces for as long as it is listened to. For ever would never fail a test: after a long while it gives up.
class Chatterbox final : public transport::Channel {
 public:
  void send(std::span<const std::byte> /*message*/) override {}
  [[nodiscard]] bool receive(transport::Bytes& message, transport::Deadline /*deadline*/) override {
    gave_up_ = gave_up_ || transport::Clock::now() >= end_;
    if (gave_up_) return false;
    const auto frame = encoder_.encode(wire::Forces());
    message.assign(frame.begin(), frame.end());
    return true;
  }
  [[nodiscard]] int wakeup() const override { return silent_.near_->wakeup(); }
  [[nodiscard]] bool gave_up() const { return gave_up_; }

 private:
  transport::Deadline end_ = grainstep::testing::soon();
  bool gave_up_ = false;
  wire::Encoder encoder_;
  ByHand silent_{"impactor"};
};

class TalkativePeer : public ::testing::Test {
 protected:
  Chatterbox impactor_;
  ByHand structure_{"structure"};
  EventLoop loop_;
  Hub hub_{impactor_, *structure_.near_, loop_};
};

TEST_F(TalkativePeer, IsGivenUpAfterStop) {
  const scene::Scene scene;
  Session session(hub_, {.scene = scene, .hash = 1, .end = 1.0}, {.stop_s = 0.05});
  hub_.impactor().introduced = true;
  session.abandon("something else", "");
  EXPECT_TRUE(hub_.impactor().finished);
  EXPECT_FALSE(impactor_.gave_up());
}

TEST_F(TalkativePeer, ItsLastWordsAreNotHeardForEver) {
  const auto handler = [](Peer& peer, const wire::Frame& frame) { peer.messages.refuse("Ready", frame); };
  EXPECT_THROW(hub_.run(
                   handler, [] { return false; }, Hub::within(60.0)),
               PeerError);
  EXPECT_FALSE(impactor_.gave_up());
}

}  // namespace
}  // namespace grainstep::orchestrator
