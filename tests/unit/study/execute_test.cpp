#include <gtest/gtest.h>

#include "orchestrator/study/study_progress.hpp"

namespace grainstep::study {
namespace {

TEST(Remaining, IsUnknownAtFirst) {
  EXPECT_LT(Remaining::seconds(1.0, 10.0, 10.0, {}), 0.0);
  EXPECT_LT(Remaining::seconds(100.0, 0.0, 10.0, {}), 0.0);
}

TEST(Remaining, FollowsTheMeasuredRate) {
  // 30 s of estimated work took 60 s; 50 s wait, 5 of 10 are left of the run in progress.
  const double left = Remaining::seconds(60.0, 25.0, 50.0, {{.estimate = 10.0, .fraction = 0.5, .elapsed = 9.0}});
  EXPECT_NEAR(left, 55.0 * 60.0 / 30.0, 1e-12);
}

TEST(Remaining, IsNoLessThanTheSlowestRunNeeds) {
  const double left = Remaining::seconds(100.0, 1000.0, 0.0, {{.estimate = 10.0, .fraction = 0.25, .elapsed = 90.0}});
  EXPECT_NEAR(left, 270.0, 1e-9);
}

}  // namespace
}  // namespace grainstep::study
