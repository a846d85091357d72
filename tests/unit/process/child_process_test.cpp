#include "process/child_process.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "patience.hpp"

namespace grainstep::process {
namespace {

constexpr std::chrono::milliseconds long_enough = testing::patience;

class ChildProcessTest : public ::testing::Test {
 protected:
  static Command shell(const std::string& script) { return {"/bin/sh", {"-c", script}, {}}; }

  /// Blocks until another process has written a line into this named pipe.
  std::string line_from(const std::filesystem::path& pipe) const {
    std::ifstream in(pipe);
    std::string line;
    std::getline(in, line);
    return line;
  }
  std::filesystem::path make_pipe(const std::string& name) const {
    auto path = directory_.path() / name;
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path;
  }
  /// Waits until a process that is not our child is gone.
  static bool gone(pid_t id) {
    const int descriptor = static_cast<int>(::syscall(SYS_pidfd_open, id, 0));
    if (descriptor < 0) {
      return errno == ESRCH;
    }
    pollfd item{descriptor, POLLIN, 0};
    const int ready = ::poll(&item, 1, testing::patience_ms);
    ::close(descriptor);
    return ready == 1;
  }

  TemporaryDirectory directory_;
  std::filesystem::path log_ = directory_.path() / "log";
};

TEST_F(ChildProcessTest, reports_the_exit_code_and_what_was_written) {
  ChildProcess child("impactor", shell("echo first; echo second >&2; echo $GREETING; exit 3"), log_);
  EXPECT_EQ(child.describe_end(), "is running");
  ASSERT_TRUE(child.wait(long_enough));
  EXPECT_EQ(child.exit_code(), 3);
  EXPECT_EQ(child.describe_end(), "exited with code 3");
  EXPECT_EQ(child.log_tail(2), "second\n\n");
}

TEST_F(ChildProcessTest, tells_that_it_was_stopped) {
  ChildProcess child("impactor", shell("kill -STOP $$"), log_);
  const auto deadline = std::chrono::steady_clock::now() + long_enough;
  while (child.describe_end() == "is running" && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
  }
  EXPECT_EQ(child.describe_end(), "is stopped (SIGSTOP, or a debugger); SIGCONT would let it go on");
}

TEST_F(ChildProcessTest, adds_to_the_environment) {
  Command command = shell("echo $GREETING from $HOME_OF_TEST");
  command.environment = {{"GREETING", "hello"}, {"HOME_OF_TEST", "here"}};
  ChildProcess child("impactor", command, log_);
  ASSERT_TRUE(child.wait(long_enough));
  EXPECT_EQ(child.log_tail(1), "hello from here\n");
}

TEST_F(ChildProcessTest, its_descriptor_tells_of_a_violent_end) {
  ChildProcess child("structure", shell("kill -KILL $$"), log_);
  pollfd item{child.descriptor(), POLLIN, 0};
  ASSERT_EQ(::poll(&item, 1, testing::patience_ms), 1);
  EXPECT_TRUE(child.ended());
  EXPECT_EQ(child.exit_code(), std::nullopt);
  EXPECT_EQ(child.describe_end(), "killed by signal 9 (SIGKILL)");
}

TEST_F(ChildProcessTest, terminate_gives_time_to_clean_up) {
  const auto pipe = make_pipe("ready");
  ChildProcess child("structure",
                     shell("trap 'exit 5' TERM; echo up > " + pipe.string() + "; while :; do sleep 0.01; done"), log_);
  ASSERT_EQ(line_from(pipe), "up");
  child.terminate(long_enough);
  EXPECT_EQ(child.describe_end(), "exited with code 5");
}

TEST_F(ChildProcessTest, terminate_kills_the_stubborn_and_their_children) {
  const auto pipe = make_pipe("ready");
  ChildProcess child("impactor", shell("trap '' TERM; sleep 600 & echo $! > " + pipe.string() + "; wait; wait"), log_);
  const pid_t grandchild = std::stoi(line_from(pipe));
  child.terminate(std::chrono::milliseconds(50));
  EXPECT_EQ(child.describe_end(), "killed by signal 9 (SIGKILL)");
  EXPECT_TRUE(gone(grandchild));
}

TEST_F(ChildProcessTest, dies_with_a_parent_that_was_killed) {
  const auto pipe = make_pipe("ready");
  const pid_t parent = ::fork();
  ASSERT_GE(parent, 0);
  if (parent == 0) {
    ChildProcess child("impactor", shell("echo $$ > " + pipe.string() + "; exec sleep 600"), log_);
    ::pause();
    ::_exit(0);
  }
  const pid_t child = std::stoi(line_from(pipe));
  ASSERT_EQ(::kill(child, 0), 0);
  ::kill(parent, SIGKILL);
  ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
  EXPECT_TRUE(gone(child));
}

TEST_F(ChildProcessTest, a_program_that_cannot_start_is_bad_input) {
  try {
    const ChildProcess child("impactor", {"/nonexistent/program", {}, {}}, log_);
    FAIL() << "it started";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "impactor: cannot start /nonexistent/program: No such file or directory");
  }
  EXPECT_THROW(ChildProcess("impactor", shell("true"), "/nonexistent/log"), InputError);
}

}  // namespace
}  // namespace grainstep::process
