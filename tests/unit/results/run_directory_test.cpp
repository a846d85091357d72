#include "results/run_directory.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <set>

#include "base/error.hpp"
#include "results/snapshots.hpp"
#include "scratch.hpp"

namespace grainstep::results {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using State = Occupation::State;

void touch(const fs::path& path) { std::ofstream(path) << "x"; }

std::string refusal_of(const RunDirectory& directory, Existing existing = Existing::refuse) {
  try {
    static_cast<void>(directory.prepare(existing));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Everything below a folder, by name.
std::set<std::string> contents_of(const fs::path& folder) {
  std::set<std::string> out;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) out.insert(entry.path().lexically_relative(folder).string());
  }
  return out;
}

wire::Snapshot a_triangle(bool mesh) {
  wire::Snapshot out;
  for (const double x : {0.0, 0.0, 1.0, 0.0, 0.0, 1.0}) out.add_position(x);
  for (const unsigned node : {0U, 1U, 2U}) {
    if (mesh) out.add_cell(node);
  }
  return out;
}

/// All that a run writes, as it writes it: every kind of snapshot, files that were cut off while they were written.
void leave_a_run(const RunDirectory& directory) {
  ResultsFile file(directory.results(), {});
  Snapshots snapshots(directory, file);
  snapshots.add(wire::STRUCTURE, 0.0, a_triangle(true));
  snapshots.add(wire::IMPACTOR, 0.0, a_triangle(true));
  snapshots.add(wire::IMPACTOR, 0.0, a_triangle(false));
  for (const fs::path& one : {directory.summary(), directory.scene(), directory.logs() / "impactor.log",
                              directory.logs() / "structure.log"}) {
    touch(one);
  }
  for (const fs::path& cut_off : {directory.summary(), directory.series("impactor"), directory.scene(),
                                  directory.paraview() / "impactor_12345.vtu"}) {
    touch(cut_off.string() + ".part");
  }
  // A new run that is ended early would go on with those of the old one.
  fs::create_directories(directory.checkpoints());
  for (const char* kept : {"window-7.checkpoint", "window-12345.checkpoint", "window-8.checkpoint.part"}) {
    touch(directory.checkpoints() / kept);
  }
}

TEST(RunDirectory, IsMadeWithItsParents) {
  const Scratch scratch;
  const RunDirectory directory(scratch.path() / "a" / "b");
  EXPECT_EQ(refusal_of(directory), "");
  EXPECT_TRUE(fs::is_directory(directory.paraview()));
  EXPECT_FALSE(directory.holds_a_run());
}

TEST(RunDirectory, WithARunIsRefusedAndLeftAsItIs) {
  const Scratch scratch;
  const RunDirectory directory(scratch.path());
  touch(directory.summary());
  EXPECT_THAT(refusal_of(directory), HasSubstr("holds a run already"));
  EXPECT_THAT(refusal_of(directory), HasSubstr("--force"));
  EXPECT_EQ(contents_of(scratch.path()), std::set<std::string>{"summary.json"});
}

TEST(RunDirectory, ReplacingRemovesAllThatARunWroteAndNothingElse) {
  const Scratch scratch;
  const RunDirectory directory(scratch.path());
  EXPECT_EQ(refusal_of(directory), "");
  leave_a_run(directory);
  EXPECT_GT(contents_of(scratch.path()).size(), 12U);
  const std::set<std::string> of_people = {"notes.txt",
                                           "impactor.txt",
                                           "own.pvd",
                                           "paraview/view.pvsm",
                                           "paraview/structure_best.vtu",
                                           "logs/notes.txt",
                                           "logs/impactor-2.log",
                                           "pictures.part",
                                           "checkpoints/window-x.checkpoint"};
  for (const std::string& file : of_people) touch(scratch.path() / file);
  EXPECT_EQ(refusal_of(directory, Existing::replace), "");
  std::set<std::string> left = of_people;
  left.insert("run.lock");
  EXPECT_EQ(contents_of(scratch.path()), left);
}

TEST(RunDirectory, LinksAreNotFollowed) {
  const Scratch scratch;
  const fs::path elsewhere = scratch.path() / "elsewhere";
  fs::create_directories(elsewhere);
  for (const char* file : {"results.h5", "particles_0000.vtp", "run.lock"}) touch(elsewhere / file);
  const RunDirectory directory(scratch.path() / "run");
  fs::create_directories(directory.path());
  fs::create_symlink(elsewhere / "results.h5", directory.results());
  fs::create_symlink("summary.json", directory.summary());  // leads to itself
  EXPECT_THAT(refusal_of(directory), HasSubstr("holds a run already"));
  EXPECT_EQ(refusal_of(directory, Existing::replace), "");
  EXPECT_FALSE(directory.holds_a_run());

  fs::remove_all(directory.paraview());
  fs::create_symlink(elsewhere, directory.paraview());
  touch(directory.summary());
  EXPECT_THAT(refusal_of(directory, Existing::replace), HasSubstr("paraview: is a link"));
  EXPECT_TRUE(directory.holds_a_run()) << "what is refused is left as it is";
  fs::remove(directory.paraview());
  fs::remove(directory.lock());
  fs::create_symlink(elsewhere / "run.lock", directory.lock());
  EXPECT_THAT(refusal_of(directory, Existing::replace), HasSubstr("run.lock: cannot be written"));
  EXPECT_EQ(contents_of(elsewhere), (std::set<std::string>{"particles_0000.vtp", "results.h5", "run.lock"}));
}

TEST(RunDirectory, BelowAFileOrOnAReadOnlySystemIsRefusedWithTheReason) {
  const Scratch scratch;
  touch(scratch.path() / "file");
  EXPECT_THAT(refusal_of(RunDirectory(scratch.path() / "file" / "run")), HasSubstr("cannot be made"));
  EXPECT_THAT(refusal_of(RunDirectory("/proc/grainstep-run")), HasSubstr("/proc/grainstep-run"));
}

TEST(RunDirectory, ASecondRunIsRefusedWithTheNumberOfTheFirstWhateverItWants) {
  const Scratch scratch;
  const RunDirectory directory(scratch.path() / "run");
  EXPECT_EQ(directory.occupation().state, State::unknown);
  const std::string own = "process " + std::to_string(::getpid());
  {
    const DirectoryLock first = directory.prepare(Existing::refuse);
    touch(directory.scene());
    for (const Existing existing : {Existing::refuse, Existing::replace}) {
      EXPECT_THAT(refusal_of(directory, existing), HasSubstr(own));
      EXPECT_THAT(refusal_of(directory, existing), HasSubstr("a run works in this directory"));
    }
    EXPECT_TRUE(fs::exists(directory.scene()));
    EXPECT_EQ(directory.occupation().state, State::held);
    EXPECT_THAT(directory.occupation().holder, HasSubstr(own));
  }
  EXPECT_EQ(directory.occupation().state, State::left);
  EXPECT_THAT(directory.occupation().holder, HasSubstr(own));
  EXPECT_EQ(refusal_of(directory, Existing::replace), "");
}

TEST(RunDirectory, TheLockEndsWithItsHolderWhateverEndsThat) {
  const Scratch scratch;
  const RunDirectory directory(scratch.path() / "run");
  std::array<int, 2> ready{};
  ASSERT_EQ(::pipe(ready.data()), 0);
  const pid_t holder = ::fork();
  ASSERT_GE(holder, 0);
  if (holder == 0) {
    const DirectoryLock lock = directory.prepare(Existing::refuse);
    static_cast<void>(!::write(ready[1], "x", 1));
    ::pause();
    ::_exit(0);
  }
  char told = 0;
  ASSERT_EQ(::read(ready[0], &told, 1), 1);
  EXPECT_THAT(refusal_of(directory), HasSubstr("process " + std::to_string(holder)));
  ::kill(holder, SIGKILL);
  ASSERT_EQ(::waitpid(holder, nullptr, 0), holder);
  EXPECT_EQ(directory.occupation().state, State::left);
  EXPECT_EQ(refusal_of(directory), "");
}

}  // namespace
}  // namespace grainstep::results
