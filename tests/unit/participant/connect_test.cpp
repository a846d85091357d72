#include "participant/connect.hpp"

#include <gtest/gtest.h>

#include <future>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "patience.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::participant {
namespace {

class Connect : public ::testing::Test {
 protected:
  TemporaryDirectory directory_;
  std::string endpoint_ = "ipc://" + (directory_.path() / "structure").string();
};

TEST_F(Connect, an_orchestrator_that_never_answers_is_a_peer_error) {
  EXPECT_THROW((void)open({.endpoint = endpoint_, .curve_dir = {}, .connect_deadline_s = 0.05}), PeerError);
}

TEST_F(Connect, keys_that_are_not_there_are_bad_input) {
  EXPECT_THROW((void)open({.endpoint = "tcp://127.0.0.1:9", .curve_dir = directory_.path()}), InputError);
}

TEST_F(Connect, reaches_the_orchestrator) {
  const auto deadline = testing::soon();
  auto orchestrator = transport::ZmqChannel::bind(endpoint_);
  auto participant = std::async(std::launch::async, [&] {
    const auto channel = open({.endpoint = endpoint_, .curve_dir = {}});
    channel->send(transport::Bytes(2));
  });
  transport::Bytes message;
  EXPECT_TRUE(orchestrator->receive(message, deadline));
  EXPECT_EQ(message.size(), 2U);
  participant.get();
}

}  // namespace
}  // namespace grainstep::participant
