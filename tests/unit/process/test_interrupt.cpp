#include "process/interrupt.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

namespace grainstep::process {
namespace {

TEST(Interrupt, the_first_signal_is_readable) {
  Interrupt interrupt;
  EXPECT_FALSE(interrupt.raised());
  ::kill(::getpid(), SIGTERM);
  pollfd item{interrupt.descriptor(), POLLIN, 0};
  ASSERT_EQ(::poll(&item, 1, 30'000), 1);
  EXPECT_TRUE(interrupt.raised());
  EXPECT_TRUE(interrupt.raised());
}

TEST(InterruptDeathTest, the_second_signal_ends_the_process) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        Interrupt interrupt;
        ::kill(::getpid(), SIGINT);
        if (!interrupt.raised()) {
          ::_exit(1);
        }
        ::kill(::getpid(), SIGINT);
        ::_exit(2);
      },
      ::testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace grainstep::process
