/// The one place to wait: sources come and go while it waits, and none that has gone costs anything.
#include "orchestrator/session/event_loop.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace grainstep::orchestrator {
namespace {

/// A pipe whose reading end is readable from the start, and stays so.
class Readable {
 public:
  Readable() {
    EXPECT_EQ(::pipe(ends_.data()), 0);
    EXPECT_EQ(::write(ends_[1], "x", 1), 1);
  }
  Readable(const Readable&) = delete;
  Readable& operator=(const Readable&) = delete;
  ~Readable() {
    for (const int end : ends_) ::close(end);
  }
  [[nodiscard]] int fd() const { return ends_[0]; }

 private:
  std::array<int, 2> ends_{};
};

transport::Deadline now() { return transport::Clock::now(); }

TEST(EventLoop, RunsTheActionOfWhatIsReadableUntilItIsRemoved) {
  const Readable source;
  EventLoop loop;
  int calls = 0;
  loop.add(source.fd(), [&] { ++calls; });
  loop.wait(now());
  loop.wait(now());
  EXPECT_EQ(calls, 2);
  loop.remove(source.fd());
  loop.wait(now());
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(loop.size(), 0U);
}

TEST(EventLoop, AnActionMayRemoveItselfOthersAndAddMore) {
  const Readable first;
  const Readable second;
  EventLoop loop;
  int of_second = 0;
  loop.add(first.fd(), [&] {
    loop.remove(first.fd());
    loop.remove(second.fd());
    for (int i = 0; i < 100; ++i) loop.add(second.fd(), [&] { ++of_second; });
  });
  loop.add(second.fd(), [] { FAIL() << "it was removed before its turn"; });
  loop.wait(now());
  EXPECT_EQ(of_second, 0) << "what was added in a turn has its first turn next";
  loop.wait(now());
  EXPECT_EQ(of_second, 100);
}

TEST(EventLoop, AnActionThatThrowsLeavesTheOthersAsTheyAre) {
  const Readable first;
  const Readable second;
  EventLoop loop;
  int calls = 0;
  loop.add(first.fd(), [&] {
    loop.remove(first.fd());
    throw std::runtime_error("the first one fails");
  });
  loop.add(second.fd(), [&] { ++calls; });
  EXPECT_THROW(loop.wait(now()), std::runtime_error);
  loop.wait(now());
  EXPECT_EQ(calls, 1);
}

// A study adds and removes one process after the other; poll() takes no more places than files may be open.
TEST(EventLoop, ManyThatCameAndWentTakeNoPlace) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const rlimit few{.rlim_cur = 64, .rlim_max = before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  EventLoop loop;
  int calls = 0;
  for (int run = 0; run < 200; ++run) {
    const Readable process;
    loop.add(process.fd(), [&] {
      ++calls;
      loop.remove(process.fd());
    });
    EXPECT_NO_THROW(loop.wait(now())) << "after " << run;
  }
  EXPECT_EQ(calls, 200);
  EXPECT_EQ(loop.size(), 0U);
  ::setrlimit(RLIMIT_NOFILE, &before);
}

}  // namespace
}  // namespace grainstep::orchestrator
