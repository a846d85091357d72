#include "results/results_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "scratch.hpp"

namespace grainstep::results {
namespace {

using ::testing::HasSubstr;

Entry time_entry(double value) { return {.dataset = "/series/time", .meaning = {"s", "time"}, .value = value}; }

std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

TEST(ResultsFile, AppendsRowsAcrossBurstsWithUnitsAndTitles) {
  const Scratch scratch;
  ResultsFile file(scratch.path() / "r.h5", {{"/scene/yaml", "the scene", "a: 1\n"}});
  file.add({time_entry(0.0)});
  file.add({time_entry(0.5)});
  file.add(Line{.dataset = "/profiles/pressure", .meaning = {"Pa", "pressure"}, .values = {1.0, 2.0, 3.0}});
  file.flush();
  file.add({time_entry(1.5)});
  file.add(Line{.dataset = "/profiles/pressure", .meaning = {"Pa", "pressure"}, .values = {4.0, 5.0, 6.0}});
  file.add(Array{.dataset = "/snapshots/structure/0000/cell",
                 .meaning = {"", "triangles"},
                 .columns = 3,
                 .values = {},
                 .indices = {0, 1, 2}});
  file.flush();
  const std::string seen = read_with("hdf5", scratch.path() / "r.h5");
  EXPECT_THAT(seen, HasSubstr("series/time unit=s title=time [0.0, 0.5, 1.5]\n"));
  EXPECT_THAT(seen, HasSubstr("profiles/pressure unit=Pa title=pressure [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]\n"));
  EXPECT_THAT(seen, HasSubstr("snapshots/structure/0000/cell unit= title=triangles [[0, 1, 2]]\n"));
  EXPECT_THAT(seen, HasSubstr("a: 1"));
}

TEST(ResultsFile, HoldsTheLastBurstWhateverIsPending) {
  const Scratch scratch;
  ResultsFile file(scratch.path() / "r.h5", {});
  file.add({time_entry(0.25)});
  file.flush();
  file.add({time_entry(0.75)});  // never written: as if the process ended here
  EXPECT_THAT(read_with("hdf5", scratch.path() / "r.h5"), HasSubstr("[0.25]"));
}

TEST(ResultsFile, EqualContentsAreEqualBytes) {
  const Scratch scratch;
  for (const char* name : {"a.h5", "b.h5"}) {
    ResultsFile file(scratch.path() / name, {{"/scene/hash", "hash", "12"}});
    file.add({time_entry(1.0)});
    file.flush();
  }
  EXPECT_EQ(bytes_of(scratch.path() / "a.h5"), bytes_of(scratch.path() / "b.h5"));
}

TEST(ResultsFile, RefusesToReplaceAFile) {
  const Scratch scratch;
  const ResultsFile file(scratch.path() / "r.h5", {});
  EXPECT_THROW(ResultsFile(scratch.path() / "r.h5", {}), OutputError);
}

// A limit on the size of files stands for a full disk: the system refuses the bytes in the same way.
TEST(ResultsFile, AFullDiskEndsWithAReasonAndKeepsTheLastBurst) {
  const Scratch scratch;
  ResultsFile file(scratch.path() / "r.h5", {});
  file.add({time_entry(0.25)});
  file.flush();
  const std::string before = bytes_of(scratch.path() / "r.h5");
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit low = old;
  low.rlim_cur = before.size() + 64 * 1024;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &low), 0);
  file.add(Array{.dataset = "/big", .meaning = {"", ""}, .values = std::vector<double>(100000, 1.0), .indices = {}});
  std::string text;
  try {
    file.flush();
  } catch (const OutputError& error) {
    text = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(text, HasSubstr("r.h5: no room for"));
  EXPECT_EQ(bytes_of(scratch.path() / "r.h5"), before);
}

TEST(ResultsFile, ANewFileThatFindsNoRoomIsAnErrorAndNotMade) {
  const Scratch scratch;
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit low = old;
  low.rlim_cur = 512;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &low), 0);
  std::string text;
  try {
    const ResultsFile file(scratch.path() / "r.h5", {});
  } catch (const OutputError& error) {
    text = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(text, HasSubstr("r.h5: no room for"));
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "r.h5"));
}

TEST(ResultsFile, CanBeReadBackByName) {
  const Scratch scratch;
  ResultsFile file(scratch.path() / "r.h5", {{"/scene/title", "title", "a slug"}});
  file.add({time_entry(0.25)});
  file.flush();
  const h5::File back = h5::File::read(scratch.path() / "r.h5");
  EXPECT_EQ(back.read_text("/scene/title"), "a slug");
  EXPECT_THAT(back.read_doubles("/series/time"), ::testing::ElementsAre(0.25));
  EXPECT_TRUE(back.has("/series/time"));
  EXPECT_FALSE(back.has("/nowhere/time"));
}

}  // namespace
}  // namespace grainstep::results
