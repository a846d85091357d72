// A file is there as it was, or as it is meant to be: never in between.
#include "results/atomic_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "base/error.hpp"
#include "scratch.hpp"

namespace grainstep::results {
namespace {

std::string contents(std::istream& in) {
  std::string line;
  std::getline(in, line);
  return line;
}

TEST(AtomicFile, WhoReadsTheOldFileReadsItToItsEnd) {
  const Scratch scratch;
  const std::filesystem::path path = scratch.path() / "summary.json";
  write_atomically(path, "the first");
  std::ifstream reader(path);
  write_atomically(path, "another");
  EXPECT_EQ(contents(reader), "the first");
  std::ifstream again(path);
  EXPECT_EQ(contents(again), "another");
}

TEST(AtomicFile, LeavesNothingBesideIt) {
  const Scratch scratch;
  write_atomically(scratch.path() / "summary.json", "all");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(scratch.path()), {}), 1);
  EXPECT_THROW(write_atomically(scratch.path() / "nowhere" / "summary.json", "all"), OutputError);
}

}  // namespace
}  // namespace grainstep::results
