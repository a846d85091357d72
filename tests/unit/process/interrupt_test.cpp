#include "process/interrupt.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include "patience.hpp"

namespace grainstep::process {
namespace {

TEST(Interrupt, the_first_signal_is_readable) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    Interrupt interrupt;
    EXPECT_FALSE(interrupt.raised());
    ::kill(::getpid(), number);
    pollfd item{interrupt.descriptor(), POLLIN, 0};
    ASSERT_EQ(::poll(&item, 1, grainstep::testing::patience_ms), 1) << number;
    EXPECT_TRUE(interrupt.raised());
    EXPECT_TRUE(interrupt.raised());
  }
}

TEST(Interrupt, a_wish_is_told_once_and_ends_nothing) {
  {
    Interrupt interrupt;
    EXPECT_FALSE(interrupt.asked());
    for (int time = 0; time < 2; ++time) {
      ::kill(::getpid(), SIGUSR1);
      pollfd item{interrupt.descriptor(), POLLIN, 0};
      ASSERT_EQ(::poll(&item, 1, grainstep::testing::patience_ms), 1);
      EXPECT_FALSE(interrupt.raised());
      EXPECT_TRUE(interrupt.asked());
      EXPECT_FALSE(interrupt.asked());
    }
    ::kill(::getpid(), SIGTERM);
    EXPECT_TRUE(interrupt.raised());
    ::kill(::getpid(), SIGUSR1);
  }
  SUCCEED() << "one that came too late has ended nothing either";
}

TEST(Interrupt, a_closed_terminal_is_survived_under_nohup) {
  const auto before = ::signal(SIGHUP, SIG_IGN);
  {
    Interrupt interrupt;
    ::kill(::getpid(), SIGHUP);
    EXPECT_FALSE(interrupt.raised());
  }
  ::signal(SIGHUP, before);
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
