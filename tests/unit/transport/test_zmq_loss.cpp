/// Peers that are killed or frozen: real processes, forked before this one has any thread.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.hpp"
#include "temporary_directory.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::transport {
namespace {

Deadline soon() { return in(std::chrono::seconds(30)); }

/// Fast heartbeats; the product's own are the same code with longer times.
ZmqOptions fast() { return {.heartbeat_s = 0.1, .silence_s = 0.3, .linger_s = 0.2}; }

class ZmqLoss : public ::testing::Test {
 protected:
  /// A child process that connects, greets and then waits for a message, for ever. Exit code 4: it lost us.
  void fork_peer() {
    child_ = ::fork();
    ASSERT_GE(child_, 0);
    if (child_ == 0) {
      int code = 0;
      try {
        auto channel = ZmqChannel::connect(endpoint_, soon(), fast());
        channel->send(Bytes(5));
        Bytes message;
        code = channel->receive(message, soon()) ? 0 : 1;
      } catch (const PeerError&) {
        code = 4;
      }
      ::_exit(code);
    }
    bound_ = ZmqChannel::bind(endpoint_, fast());
    ASSERT_TRUE(bound_->receive(message_, soon()));
    ASSERT_EQ(message_.size(), 5U);
  }

  int child_exit_code() {
    int status = 0;
    ::waitpid(child_, &status, 0);
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  ~ZmqLoss() override {
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
  }

  testing::TemporaryDirectory directory_;
  std::string endpoint_ = "ipc://" + (directory_.path() / "channel").string();
  std::unique_ptr<ZmqChannel> bound_;
  Bytes message_;
  pid_t child_ = -1;
};

TEST_F(ZmqLoss, a_killed_peer_is_noticed) {
  fork_peer();
  ::kill(child_, SIGKILL);
  EXPECT_THROW((void)bound_->receive(message_, soon()), PeerError);
}

TEST_F(ZmqLoss, a_frozen_peer_is_noticed) {
  fork_peer();
  ::kill(child_, SIGSTOP);
  EXPECT_THROW((void)bound_->receive(message_, soon()), PeerError);
  EXPECT_THROW(bound_->send(message_), PeerError);
}

TEST_F(ZmqLoss, a_peer_that_thaws_finds_itself_alone) {
  fork_peer();
  ::kill(child_, SIGSTOP);
  EXPECT_THROW((void)bound_->receive(message_, soon()), PeerError);
  ::kill(child_, SIGCONT);
  EXPECT_EQ(child_exit_code(), 4);
}

TEST_F(ZmqLoss, a_peer_that_only_computes_is_not_lost) {
  fork_peer();
  EXPECT_FALSE(bound_->receive(message_, in(std::chrono::seconds(1))));  // it is silent for many heartbeats
  bound_->send(message_);
  EXPECT_EQ(child_exit_code(), 0);
}

TEST_F(ZmqLoss, a_vanished_orchestrator_ends_the_peer) {
  fork_peer();
  bound_.reset();
  EXPECT_EQ(child_exit_code(), 4);
}

}  // namespace
}  // namespace grainstep::transport
