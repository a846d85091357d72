// Directories of killed processes are taken away by the next one, and nothing else is.
#include "base/owned_directory.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <string>

#include "base/temporary_directory.hpp"

namespace grainstep {
namespace {

namespace fs = std::filesystem;

/// A process that has a directory in `parent`, until it is killed.
class Other {
 public:
  explicit Other(const fs::path& parent) {
    std::array<int, 2> pipe{};
    EXPECT_EQ(::pipe(pipe.data()), 0);
    process_ = ::fork();
    if (process_ == 0) {
      const OwnedDirectory mine(parent);
      std::ofstream(mine.path() / "socket") << "x";
      const std::string path = mine.path().string();
      if (::write(pipe[1], path.c_str(), path.size() + 1) < 0) ::_exit(1);
      while (true) ::pause();
    }
    std::array<char, 4096> path{};
    EXPECT_GT(::read(pipe[0], path.data(), path.size() - 1), 0);
    path_ = path.data();
    ::close(pipe[0]);
    ::close(pipe[1]);
  }
  ~Other() { kill(); }
  Other(const Other&) = delete;
  Other& operator=(const Other&) = delete;
  Other(Other&&) = delete;
  Other& operator=(Other&&) = delete;

  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  pid_t process_ = -1;
  fs::path path_;
};

TEST(OwnedDirectory, IsPrivateAndGoneWithItsOwner) {
  const TemporaryDirectory parent;
  fs::path path;
  {
    const OwnedDirectory one(parent.path());
    path = one.path();
    struct stat status {};
    ASSERT_EQ(::stat(path.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700U);
    ASSERT_EQ(::stat(path.parent_path().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0700U);
    std::ofstream(path / "socket") << "x";
  }
  EXPECT_FALSE(fs::exists(path.parent_path()));
}

TEST(OwnedDirectory, OfAKilledProcessIsTakenAwayByTheNext) {
  const TemporaryDirectory parent;
  Other killed(parent.path());
  const Other living(parent.path());
  const OwnedDirectory mine(parent.path());
  EXPECT_TRUE(fs::exists(killed.path())) << "it is alive";
  killed.kill();
  EXPECT_TRUE(fs::exists(killed.path()));
  const OwnedDirectory next(parent.path());
  EXPECT_FALSE(fs::exists(killed.path()));
  EXPECT_FALSE(fs::exists(killed.path().parent_path()));
  EXPECT_TRUE(fs::exists(living.path() / "socket"));
  EXPECT_TRUE(fs::exists(mine.path()));
}

// Directories of such a name without a mark, or with one that is no file; links to anywhere; what others may enter.
TEST(OwnedDirectory, WhatIsNoneIsLeftAlone) {
  const TemporaryDirectory parent;
  const TemporaryDirectory elsewhere;
  const auto made = [](const fs::path& path) {
    fs::create_directories(path);
    fs::permissions(path, fs::perms::owner_all);
    std::ofstream(path / "file") << "x";
    return path;
  };
  const auto marked = [&](const fs::path& path) {
    std::ofstream(made(path) / "of-a-process-of-grainstep") << "";
    return path;
  };
  const fs::path of_a_user = made(parent.path() / "grainstep-aaaaaa");
  const fs::path foreign = marked(parent.path() / "something");
  const fs::path target = marked(elsewhere.path() / "target");
  const fs::path link = parent.path() / "grainstep-bbbbbb";
  fs::create_directory_symlink(target, link);
  const fs::path open_to_all = marked(parent.path() / "grainstep-cccccc");
  fs::permissions(open_to_all, fs::perms::all);
  std::ofstream(parent.path() / "grainstep-dddddd") << "x";
  const fs::path linked_mark = made(parent.path() / "grainstep-eeeeee");
  fs::create_symlink(target / "file", linked_mark / "of-a-process-of-grainstep");
  const fs::path pipe_as_mark = made(parent.path() / "grainstep-ffffff");
  ASSERT_EQ(::mkfifo((pipe_as_mark / "of-a-process-of-grainstep").c_str(), 0600), 0);
  const fs::path left = marked(parent.path() / "grainstep-gggggg");
  remove_abandoned_directories(parent.path());
  for (const fs::path& kept :
       {of_a_user, foreign, target, link, open_to_all, parent.path() / "grainstep-dddddd", linked_mark, pipe_as_mark}) {
    EXPECT_TRUE(fs::exists(kept)) << kept;
  }
  EXPECT_TRUE(fs::exists(target / "file"));
  EXPECT_FALSE(fs::exists(left));
}

}  // namespace
}  // namespace grainstep
