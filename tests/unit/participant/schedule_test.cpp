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
