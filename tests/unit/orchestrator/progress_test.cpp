#include "orchestrator/record/progress.hpp"

#include <gtest/gtest.h>

namespace grainstep::orchestrator {
namespace {

using std::chrono::seconds;

TEST(Rate, IsThatOfTheRecentPast) {
  Rate rate;
  const transport::Clock::time_point start{};
  EXPECT_EQ(rate.per_second(), 0.0);
  std::uint64_t window = 0;
  for (int s = 0; s <= 300; ++s) {
    rate.see(start + seconds(s), window);
    window += s < 200 ? 100 : 10;  // the slug compacts
  }
  EXPECT_DOUBLE_EQ(rate.per_second(), 10.0);
}

TEST(Rate, IgnoresLooksThatAreTooClose) {
  Rate rate;
  const transport::Clock::time_point start{};
  rate.see(start, 0);
  rate.see(start + std::chrono::milliseconds(1), 50);
  EXPECT_EQ(rate.per_second(), 0.0);
}

TEST(DurationText, ReadsLikeAPersonWouldSayIt) {
  EXPECT_EQ(duration_text(0.4), "0 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(200.0), "3 min 20 s");
  EXPECT_EQ(duration_text(7260.0), "2 h 1 min");
}

}  // namespace
}  // namespace grainstep::orchestrator
