/// What is particular to ZeroMQ channels: who may connect, and what is said when nobody does.
#include "transport/zmq_channel.hpp"

#include <gtest/gtest.h>

#include <future>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "patience.hpp"

namespace grainstep::transport {
namespace {

using grainstep::testing::soon;

class ZmqChannelTest : public ::testing::Test {
 protected:
  std::string ipc_endpoint() const { return "ipc://" + (directory_.path() / "channel").string(); }
  ZmqOptions with_keys(const std::string& name) {
    ZmqOptions options;
    options.curve_dir = directory_.path() / name;
    if (!std::filesystem::exists(options.curve_dir)) {
      make_keys(options.curve_dir);
    }
    return options;
  }

  /// What connect() says when it fails; the binding end looks after its connections meanwhile.
  static std::string refusal(ZmqChannel& bound, const ZmqOptions& options,
                             std::chrono::milliseconds patience = std::chrono::milliseconds(600)) {
    const Deadline deadline = in(patience);
    auto attempt = std::async(std::launch::async, [&]() -> std::string {
      try {
        (void)ZmqChannel::connect(bound.endpoint(), deadline, options);
      } catch (const PeerError& error) {
        return error.what();
      }
      return "connected";
    });
    Bytes message;
    while (attempt.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      EXPECT_FALSE(bound.receive(message, in(std::chrono::milliseconds(10))));
    }
    return attempt.get();
  }

  /// Whether a refusal says this. A busy machine may need longer than the first patience for a handshake.
  static bool says(const char* reason, ZmqChannel& bound, const ZmqOptions& options) {
    for (auto longest = std::chrono::milliseconds(600); longest < grainstep::testing::patience; longest *= 2) {
      if (refusal(bound, options, longest).find(reason) != std::string::npos) return true;
    }
    return false;
  }

  static std::unique_ptr<ZmqChannel> join(ZmqChannel& bound, const ZmqOptions& options = {}) {
    auto connecting =
        std::async(std::launch::async, [&] { return ZmqChannel::connect(bound.endpoint(), soon(), options); });
    EXPECT_TRUE(bound.wait_for_peer(soon()));
    return connecting.get();
  }

  TemporaryDirectory directory_;
};

TEST_F(ZmqChannelTest, nobody_there_is_said_at_the_deadline) {
  try {
    (void)ZmqChannel::connect(ipc_endpoint(), in(std::chrono::milliseconds(50)), {.peer = "orchestrator"});
    FAIL() << "connected";
  } catch (const PeerError& error) {
    EXPECT_EQ(error.what(),
              "orchestrator: no connection to " + ipc_endpoint() + " before the deadline: nobody answered there");
  }
}

TEST_F(ZmqChannelTest, a_participant_may_come_before_its_orchestrator) {
  auto connecting = std::async(std::launch::async, [&] { return ZmqChannel::connect(ipc_endpoint(), soon()); });
  auto bound = ZmqChannel::bind(ipc_endpoint());
  EXPECT_TRUE(bound->wait_for_peer(soon()));
  connecting.get()->send({});
  Bytes message;
  EXPECT_TRUE(bound->receive(message, soon()));
}

TEST_F(ZmqChannelTest, a_second_connector_is_turned_away_and_changes_nothing) {
  auto bound = ZmqChannel::bind(ipc_endpoint());
  auto peer = join(*bound);
  EXPECT_TRUE(says("has its peer already", *bound, {}));
  Bytes message;
  peer->send(Bytes(3));
  ASSERT_TRUE(bound->receive(message, soon()));
  bound->send(message);
  ASSERT_TRUE(peer->receive(message, soon()));
  EXPECT_EQ(message, Bytes(3));
}

TEST_F(ZmqChannelTest, only_the_right_key_opens) {
  auto bound = ZmqChannel::bind("tcp://127.0.0.1:*", with_keys("keys"));
  EXPECT_NE(refusal(*bound, {}), "connected");                   // no key at all
  EXPECT_NE(refusal(*bound, with_keys("others")), "connected");  // knows neither side's key
  // Knows the orchestrator's public key, but has a key of its own that the orchestrator does not expect.
  auto stranger = with_keys("stranger");
  std::filesystem::copy_file(directory_.path() / "keys/orchestrator.pub", stranger.curve_dir / "orchestrator.pub",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_TRUE(says("wrong key", *bound, stranger));
  EXPECT_NE(join(*bound, with_keys("keys")), nullptr);
}

TEST_F(ZmqChannelTest, tcp_beyond_this_host_wants_keys_or_permission) {
  EXPECT_THROW((void)ZmqChannel::bind("tcp://*:*"), InputError);
  EXPECT_THROW((void)ZmqChannel::connect("tcp://node17:5555", soon()), InputError);
  EXPECT_NE(ZmqChannel::bind("tcp://*:*", {.allow_plain_tcp = true}), nullptr);
  EXPECT_NE(ZmqChannel::bind("tcp://*:*", with_keys("keys")), nullptr);
}

// libzmq would take these, and neither keys nor permission would have a say.
TEST_F(ZmqChannelTest, other_schemes_are_refused_with_and_without_keys) {
  for (const auto* const endpoint : {"ws://127.0.0.1:*", "ws://0.0.0.0:*", "ipc://@grainstep-test", "inproc://name"}) {
    EXPECT_THROW((void)ZmqChannel::bind(endpoint), InputError) << endpoint;
    EXPECT_THROW((void)ZmqChannel::bind(endpoint, with_keys("keys")), InputError) << endpoint;
    EXPECT_THROW((void)ZmqChannel::bind(endpoint, {.allow_plain_tcp = true}), InputError) << endpoint;
    EXPECT_THROW((void)ZmqChannel::connect(endpoint, soon()), InputError) << endpoint;
  }
}

TEST_F(ZmqChannelTest, an_endpoint_that_cannot_be_had_is_bad_input) {
  EXPECT_THROW((void)ZmqChannel::bind("carrier-pigeon://here"), InputError);
  auto bound = ZmqChannel::bind("tcp://127.0.0.1:*");
  EXPECT_THROW((void)ZmqChannel::bind(bound->endpoint()), InputError);
  EXPECT_THROW((void)ZmqChannel::bind("ipc:///" + std::string(200, 'x')), InputError);
}

}  // namespace
}  // namespace grainstep::transport
