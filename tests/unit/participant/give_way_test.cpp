#include "participant/give_way.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <thread>

namespace grainstep::participant {
namespace {

int priority_of_this_thread() { return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())); }

TEST(GiveWay, LowersTheCallingThreadAlone) {
  const int before = priority_of_this_thread();
  if (before > 10) GTEST_SKIP() << "hardly any priority left to lower";
  int lowered = before;
  std::thread([&] {
    give_way_to_messages();
    lowered = priority_of_this_thread();
  }).join();
  EXPECT_GT(lowered, before) << "a larger number is a lower priority";
  EXPECT_EQ(priority_of_this_thread(), before);
}

}  // namespace
}  // namespace grainstep::participant
