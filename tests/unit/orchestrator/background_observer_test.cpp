/// The thread between the lock step and the recorder: nothing is lost, nothing is reordered, failures come back.
#include "orchestrator/record/background_observer.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <future>
#include <string>

#include "base/error.hpp"

namespace grainstep::orchestrator {
namespace {

/// Writes down what it is told; may be held up, or told to fail at a window's report.
class Diary final : public StepObserver {
 public:
  void forces(const wire::Forces& forces) override { note("F", forces.window()); }
  void report(wire::Role side, const wire::Report& report) override {
    if (gate_.valid()) gate_.wait();
    if (report.window() == fails_at_) throw NumericalError("limit exceeded");
    note(side == wire::IMPACTOR ? "RI" : "RS", report.window());
  }
  void snapshot(wire::Role side, wire::Snapshot snapshot) override {
    note(side == wire::IMPACTOR ? "SI" : "SS", snapshot.window());
  }
  void idle() override {}
  void finish() override { text_ += "end"; }

  std::string text_;
  std::uint64_t fails_at_ = ~0ULL;
  std::shared_future<void> gate_;

 private:
  void note(const char* what, std::uint64_t window) { text_ += what + std::to_string(window) + " "; }
};

wire::Forces forces_of(std::uint64_t window, int values = 2) {
  wire::Forces out;
  out.set_window(window);
  for (int i = 0; i < values; ++i) out.add_impulse(1.0 + i);
  return out;
}

wire::Report report_of(std::uint64_t window) {
  wire::Report out;
  out.set_window(window);
  return out;
}

wire::Snapshot snapshot_of(std::uint64_t window) {
  wire::Snapshot out;
  out.set_window(window);
  return out;
}

TEST(BackgroundObserver, HandsOverEverythingInOrder) {
  Diary diary;
  BackgroundObserver background(diary);
  std::string expected;
  for (std::uint64_t n = 0; n < 1000; ++n) {
    background.forces(forces_of(n));
    expected += "F" + std::to_string(n) + " ";
    if (n % 50 != 0) continue;
    background.report(wire::IMPACTOR, report_of(n));
    background.report(wire::STRUCTURE, report_of(n));
    background.snapshot(wire::STRUCTURE, snapshot_of(n));
    background.idle();
    const std::string number = std::to_string(n) + " ";
    expected += "RI" + number + "RS" + number + "SS" + number;
  }
  background.finish();
  background.finish();
  EXPECT_EQ(diary.text_, expected + "end");
}

TEST(BackgroundObserver, ThrowsTheOthersExceptionOnceAndRecordsNothingMore) {
  Diary diary;
  diary.fails_at_ = 7;
  BackgroundObserver background(diary);
  background.forces(forces_of(7));
  const auto until_it_fails = [&] {
    background.report(wire::IMPACTOR, report_of(7));
    while (true) background.forces(forces_of(8));
  };
  EXPECT_THROW(until_it_fails(), NumericalError);
  background.forces(forces_of(9));
  EXPECT_NO_THROW(background.finish());
  EXPECT_EQ(diary.text_, "F7 ");
}

TEST(BackgroundObserver, FinishThrowsWhatNoCallHasThrown) {
  Diary diary;
  diary.fails_at_ = 3;
  BackgroundObserver background(diary);
  background.report(wire::STRUCTURE, report_of(3));
  EXPECT_THROW(background.finish(), NumericalError);
}

TEST(BackgroundObserver, BlocksWhenTooMuchIsWaiting) {
  Diary diary;
  std::promise<void> open;
  diary.gate_ = open.get_future().share();
  BackgroundObserver background(diary, 10'000);
  background.report(wire::IMPACTOR, report_of(0));  // holds the thread at the gate
  std::promise<void> done;
  std::future<void> all_taken = done.get_future();
  std::thread forwarder([&] {
    for (std::uint64_t n = 1; n <= 100; ++n) background.forces(forces_of(n, 100));
    done.set_value();
  });
  EXPECT_EQ(all_taken.wait_for(std::chrono::milliseconds(50)), std::future_status::timeout);
  open.set_value();
  forwarder.join();
  background.finish();
  EXPECT_THAT(diary.text_, ::testing::EndsWith("F100 end"));
}

TEST(BackgroundObserver, AFailureFreesWhoIsBlocked) {
  Diary diary;
  std::promise<void> open;
  diary.gate_ = open.get_future().share();
  diary.fails_at_ = 0;
  BackgroundObserver background(diary, 10'000);
  background.report(wire::IMPACTOR, report_of(0));
  auto blocked = std::async(std::launch::async, [&] {
    for (std::uint64_t n = 1; n <= 100; ++n) background.forces(forces_of(n, 100));
  });
  open.set_value();
  try {
    blocked.get();
    background.finish();
    FAIL() << "the failure was lost";
  } catch (const NumericalError&) {
    EXPECT_EQ(diary.text_, "");
  }
}

}  // namespace
}  // namespace grainstep::orchestrator
