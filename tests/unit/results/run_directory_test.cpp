#include "results/run_directory.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "base/error.hpp"
#include "scratch.hpp"

namespace grainstep::results {
namespace {

using ::testing::HasSubstr;

void touch(const std::filesystem::path& path) { std::ofstream(path) << "x"; }

std::string refusal_of(const RunDirectory& directory, Existing existing = Existing::refuse) {
  try {
    directory.prepare(existing);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RunDirectory, IsMadeWithItsParents) {
  const Scratch scratch;
  const RunDirectory directory(scratch.path() / "a" / "b");
  directory.prepare(Existing::refuse);
  EXPECT_TRUE(std::filesystem::is_directory(directory.paraview()));
  EXPECT_FALSE(directory.holds_a_run());
}

TEST(RunDirectory, WithARunIsRefusedUnlessReplaced) {
  const Scratch scratch;
  const RunDirectory directory(scratch.path() / "run");
  directory.prepare(Existing::refuse);
  touch(directory.summary());
  touch(directory.paraview() / "particles_0000.vtp");
  touch(directory.logs() / "impactor.log");
  touch(directory.path() / "notes.txt");
  touch(directory.paraview() / "view.pvsm");
  touch(directory.logs() / "notes.txt");
  EXPECT_THAT(refusal_of(directory), HasSubstr("--force"));
  EXPECT_TRUE(std::filesystem::exists(directory.summary()));
  EXPECT_EQ(refusal_of(directory, Existing::replace), "");
  EXPECT_FALSE(std::filesystem::exists(directory.summary()));
  EXPECT_FALSE(std::filesystem::exists(directory.paraview() / "particles_0000.vtp"));
  EXPECT_FALSE(std::filesystem::exists(directory.logs() / "impactor.log"));
  for (const auto& kept :
       {directory.path() / "notes.txt", directory.paraview() / "view.pvsm", directory.logs() / "notes.txt"}) {
    EXPECT_TRUE(std::filesystem::exists(kept)) << kept << ": only the run's own files are removed";
  }
}

TEST(RunDirectory, BelowAFileOrOnAReadOnlySystemIsRefusedWithTheReason) {
  const Scratch scratch;
  touch(scratch.path() / "file");
  EXPECT_THAT(refusal_of(RunDirectory(scratch.path() / "file" / "run")), HasSubstr("cannot be made"));
  EXPECT_THAT(refusal_of(RunDirectory("/proc/grainstep-run")), HasSubstr("/proc/grainstep-run"));
}

}  // namespace
}  // namespace grainstep::results
