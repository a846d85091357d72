/// @file A peer that never stops talking: it must not keep the orchestrator from coming to an end.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "hand_played.hpp"
#include "orchestrator/session.hpp"

namespace grainstep::orchestrator {
namespace {

/// Says Hello, then sends Forces for as long as it is listened to.
class Chatterbox final : public transport::Channel {
 public:
  void send(std::span<const std::byte> /*message*/) override {}
  [[nodiscard]] bool receive(transport::Bytes& message, transport::Deadline /*deadline*/) override {
    const auto frame = encoder_.encode(wire::Forces());
    message.assign(frame.begin(), frame.end());
    return true;
  }
  [[nodiscard]] int wakeup() const override { return silent_.near_->wakeup(); }

 private:
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
}

TEST_F(TalkativePeer, ItsLastWordsAreNotHeardForEver) {
  const auto handler = [](Peer& peer, const wire::Frame& frame) { peer.messages.refuse("Ready", frame); };
  EXPECT_THROW(hub_.run(
                   handler, [] { return false; }, Hub::within(60.0)),
               PeerError);
}

}  // namespace
}  // namespace grainstep::orchestrator
