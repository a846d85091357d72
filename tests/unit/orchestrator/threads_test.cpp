#include "orchestrator/process/threads.hpp"

#include <gtest/gtest.h>

namespace grainstep::orchestrator {
namespace {

constexpr TakesThreads both{.impactor = true, .structure = true};

void expect_shares(int threads, const Cost& cost, const TakesThreads& takes, int impactor, int structure) {
  const ThreadShares shares = share_threads(threads, cost, takes);
  EXPECT_EQ(shares.impactor, impactor);
  EXPECT_EQ(shares.structure, structure);
}

TEST(ThreadShares, EachSideHasOneOfTwo) { expect_shares(2, {.impactor = 9.0, .structure = 3.0}, both, 1, 1); }

TEST(ThreadShares, OneAloneIsSharedByBoth) { expect_shares(1, {.impactor = 9.0, .structure = 3.0}, both, 1, 1); }

TEST(ThreadShares, TheSlowerSideHasTheOthers) {
  expect_shares(4, {.impactor = 9.0, .structure = 3.0}, both, 3, 1);
  expect_shares(4, {.impactor = 3.0, .structure = 9.0}, both, 1, 3);
  expect_shares(8, {.impactor = 9.0, .structure = 3.0}, both, 6, 2);
}

TEST(ThreadShares, OnlyWhoTakesThreadsGetsThem) {
  expect_shares(8, {.impactor = 9.0, .structure = 3.0}, {.impactor = false, .structure = true}, 1, 7);
  expect_shares(8, {.impactor = 9.0, .structure = 3.0}, {.impactor = true, .structure = false}, 7, 1);
  expect_shares(8, {.impactor = 9.0, .structure = 3.0}, {}, 1, 1);
}

// A rigid target: its process sleeps, and needs no core to do it.
TEST(ThreadShares, NextToNothingNeedsNoCoreOfItsOwn) {
  expect_shares(2, {.impactor = 9.0, .structure = 1e-3}, both, 2, 1);
  expect_shares(4, {.impactor = 1e-3, .structure = 9.0}, both, 1, 4);
}

}  // namespace
}  // namespace grainstep::orchestrator
