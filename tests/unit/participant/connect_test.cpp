#include "participant/connect.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
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

TEST_F(Connect, options_are_read_from_the_command_line) {
  CLI::App app;
  ConnectOptions options;
  add_connect_options(app, options);
  app.parse("--connect " + endpoint_ + " --curve-dir keys --connect-deadline 2.5 --allow-plain-tcp");
  EXPECT_EQ(options.endpoint, endpoint_);
  EXPECT_EQ(options.curve_dir, "keys");
  EXPECT_EQ(options.connect_deadline_s, 2.5);
  EXPECT_TRUE(options.allow_plain_tcp);
}

TEST_F(Connect, the_endpoint_is_required) {
  CLI::App app;
  ConnectOptions options;
  add_connect_options(app, options);
  EXPECT_THROW(app.parse(""), CLI::RequiredError);
}

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
