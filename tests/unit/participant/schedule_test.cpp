#include "participant/schedule.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace grainstep::participant {
namespace {

using ::testing::ElementsAre;

wire::Start start_of(std::uint64_t windows, double report_every, double snapshot_every) {
  wire::Start start;
  start.set_windows(windows);
  start.set_report_every(report_every);
  start.set_snapshot_every(snapshot_every);
  return start;
}

std::vector<std::uint64_t> reports(const wire::Start& start) {
  std::vector<std::uint64_t> due;
  for (std::uint64_t n = 0; n <= start.windows(); ++n) {
    if (due_at(start, n).report) due.push_back(n);
  }
  return due;
}

std::vector<std::uint64_t> snapshots(const wire::Start& start) {
  std::vector<std::uint64_t> due;
  for (std::uint64_t n = 0; n <= start.windows(); ++n) {
    if (due_at(start, n).snapshot) due.push_back(n);
  }
  return due;
}

// Found without a look at every window: the same as by one.
TEST(Schedule, TheNextOneIsTheNextOneThatIsDue) {
  for (const double every : {0.0, 0.3, 1.0, 1.7, 2.5, 3.0, 7.1, 49.9, 50.0, 51.0, 1e300}) {
    const wire::Start start = start_of(50, every, every);
    for (bool Due::*which : {&Due::report, &Due::snapshot}) {
      for (std::uint64_t window = 0; window <= 50; ++window) {
        std::uint64_t next = window + 1;
        while (next <= 50 && !(due_at(start, next).*which)) ++next;
        EXPECT_EQ(next_due(start, window, which), next) << "every " << every << ", after " << window;
      }
    }
  }
}

TEST(Schedule, TheNextOneOfARunWithoutEndIsFoundAtOnce) {
  constexpr std::uint64_t windows = 1000000000000000;
  EXPECT_EQ(next_due(start_of(windows, 0.0, 0.0), 0, &Due::snapshot), windows + 1);
  EXPECT_EQ(next_due(start_of(windows, 0.0, 0.0), 0, &Due::report), windows);
  EXPECT_EQ(next_due(start_of(windows, 2e12, 0.0), 1, &Due::report), 2000000000000U);
}

TEST(Schedule, ReportsAreSpreadEvenlyWithBothEnds) {
  EXPECT_THAT(reports(start_of(7, 2.5, 0.0)), ElementsAre(0, 3, 5, 7));
  EXPECT_THAT(reports(start_of(4, 1.0, 0.0)), ElementsAre(0, 1, 2, 3, 4));
}

TEST(Schedule, TheLastWindowIsAlwaysReported) {
  EXPECT_THAT(reports(start_of(5, 0.0, 0.0)), ElementsAre(5)) << "also where nobody says how often";
  EXPECT_THAT(reports(start_of(5, 100.0, 0.0)), ElementsAre(0, 5));
}

TEST(Schedule, SnapshotsMayBeNoneOrOnlyTheLast) {
  EXPECT_THAT(snapshots(start_of(6, 1.0, 0.0)), ElementsAre());
  EXPECT_THAT(snapshots(start_of(6, 1.0, 7.0)), ElementsAre(6));
  EXPECT_THAT(snapshots(start_of(6, 1.0, 3.0)), ElementsAre(0, 3, 6));
}

}  // namespace
}  // namespace grainstep::participant
