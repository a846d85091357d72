/// Peers that are killed or frozen: real processes, forked before this one has any thread.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "patience.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::transport {
namespace {

using grainstep::testing::soon;

/// Shorter than the product's, but nothing that a busy machine would take for a loss: threads get to run within
/// seconds.
constexpr double silence_s = 4.0;
ZmqOptions fast() { return {.heartbeat_s = 0.1, .silence_s = silence_s, .linger_s = 0.2}; }

class ZmqLoss : public ::testing::Test {
 public:
  ~ZmqLoss() override {
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      ::waitpid(child_, nullptr, 0);
    }
  }

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

  TemporaryDirectory directory_;
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
  const Deadline later = in(std::chrono::duration<double>(1.5 * silence_s));
  EXPECT_FALSE(bound_->receive(message_, later)) << "its library answers the heartbeats";
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
