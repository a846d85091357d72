#include "base/team.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace grainstep::base {
namespace {

class OfThreads : public testing::TestWithParam<int> {};

TEST_P(OfThreads, EveryPartIsDoneOnceInEveryOfManyJobs) {
  Team team(GetParam());
  for (std::int32_t parts = 0; parts < 500; ++parts) {
    std::vector<int> done(static_cast<std::size_t>(parts), 0);
    team.each(parts, [&](std::int32_t part) { ++done[static_cast<std::size_t>(part)]; });
    ASSERT_EQ(done, std::vector<int>(static_cast<std::size_t>(parts), 1));
  }
}

TEST_P(OfThreads, WhatOneThrowsComesOutAndTheTeamGoesOn) {
  Team team(GetParam());
  for (std::int32_t bad = 0; bad < 20; ++bad) {
    const auto work = [&](std::int32_t part) {
      if (part == bad) throw std::runtime_error("part " + std::to_string(part));
    };
    try {
      team.each(20, work);
      FAIL() << "part " << bad << " threw nothing";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), "part " + std::to_string(bad));
    }
  }
  std::atomic<int> sum{0};
  team.each(100, [&](std::int32_t part) { sum += part; });
  EXPECT_EQ(sum, 4950);
}

INSTANTIATE_TEST_SUITE_P(Team, OfThreads, testing::Values(1, 2, 3, 9));

// A part that is long does not have the others wait behind it.
TEST(Team, WhoIsDoneTakesWhatOthersHaveNotComeTo) {
  Team team(2);
  std::atomic<int> others{0};
  team.each(10, [&](std::int32_t part) {
    if (part != 0) {
      ++others;
      return;
    }
    while (others < 9) std::this_thread::yield();
  });
  EXPECT_EQ(others, 9);
}

}  // namespace
}  // namespace grainstep::base
