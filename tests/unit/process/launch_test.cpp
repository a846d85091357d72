#include "process/launch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fstream>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "patience.hpp"

namespace grainstep::process {
namespace {

TEST(FindProgram, looks_beside_the_running_one_then_in_path) {
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  EXPECT_EQ(find_program(self.filename()), self);
  EXPECT_EQ(find_program("sh").filename(), "sh");
  EXPECT_EQ(find_program("/bin/sh"), "/bin/sh");
  EXPECT_THROW((void)find_program("/bin"), InputError);
  try {
    (void)find_program("grainstep-nonexistent");
    FAIL() << "found it";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr((self.parent_path() / "grainstep-nonexistent").string()));
  }
}

TEST(MpiCommand, one_rank_is_the_program_itself) {
  const Command command = mpi_command(1, {"/bin/echo", {"a", "b"}, {}});
  EXPECT_EQ(command.program, "/bin/echo");
  EXPECT_THAT(command.arguments, ::testing::ElementsAre("a", "b"));
  EXPECT_THROW((void)mpi_command(0, command), InputError);
}

TEST(MpiCommand, more_ranks_than_cores_are_allowed) {
  const Command command = mpi_command(4096, {"/bin/echo", {"a"}, {{"KEY", "value"}}});
  EXPECT_EQ(command.program.filename(), "mpirun");
  EXPECT_THAT(command.arguments, ::testing::Contains("--oversubscribe"));
  EXPECT_EQ(command.arguments.back(), "a");
  EXPECT_THAT(command.environment, ::testing::Contains(std::pair<std::string, std::string>("KEY", "value")));
}

TEST(MpiCommand, as_many_ranks_as_asked_for) {
  TemporaryDirectory directory;
  const std::string script = "touch " + (directory.path() / "rank-$OMPI_COMM_WORLD_RANK").string();
  ChildProcess mpirun("impactor", mpi_command(3, {"/bin/sh", {"-c", script}, {}}), directory.path() / "log");
  ASSERT_TRUE(mpirun.wait(testing::patience));
  EXPECT_EQ(mpirun.describe_end(), "exited with code 0");
  for (const char* name : {"rank-0", "rank-1", "rank-2"})
    EXPECT_TRUE(std::filesystem::exists(directory.path() / name)) << name;
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "rank-3"));
}

TEST(MpiCommand, no_rank_outlives_a_killed_mpirun) {
  TemporaryDirectory directory;
  const auto pipe = directory.path() / "ranks";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string script = "echo $$ > " + pipe.string() + "; exec sleep 600";
  ChildProcess mpirun("impactor", mpi_command(2, {"/bin/sh", {"-c", script}, {}}), directory.path() / "log");
  std::vector<int> ranks;
  while (ranks.size() < 2) {
    std::ifstream in(pipe);
    for (pid_t id = 0; in >> id;) {
      ranks.push_back(static_cast<int>(::syscall(SYS_pidfd_open, id, 0)));
      ASSERT_GE(ranks.back(), 0);
    }
  }
  ::kill(mpirun.id(), SIGKILL);
  for (const int rank : ranks) {
    pollfd item{rank, POLLIN, 0};
    EXPECT_EQ(::poll(&item, 1, testing::patience_ms), 1);
    ::close(rank);
  }
  ASSERT_TRUE(mpirun.wait(testing::patience));
  EXPECT_EQ(mpirun.describe_end(), "killed by signal 9 (SIGKILL)");
}

}  // namespace
}  // namespace grainstep::process
