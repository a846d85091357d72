/// @file When a run asks for checkpoints: every so many seconds, at windows that are spread over the run, and once more
/// before it is ended from outside.
#pragma once

#include <atomic>
#include <cstdint>

#include "transport/channel.hpp"

namespace grainstep::orchestrator {

class SaveSchedule {
 public:
  /// `every_s`: 0 for never, but at an end from outside.
  explicit SaveSchedule(double every_s) : every_s_(every_s) {}

  /// And `count` times in `windows` windows, equally spaced, of which `done` lie behind.
  void spread(std::uint32_t count, std::uint64_t windows, std::uint64_t done);

  /// Asked now and then, with the window that is under way. Throws Interrupted once the last checkpoint is written, or
  /// took too long.
  [[nodiscard]] bool due(std::uint64_t window);

  /// A checkpoint is in its file. From any thread.
  void written() { ++written_; }

  /// One is wanted now.
  void save_now() { now_ = true; }

  /// The run is to end, after one more checkpoint.
  void end_after_next();

 private:
  [[nodiscard]] bool passes_a_mark(std::uint64_t window);

  double every_s_;
  double every_windows_ = 0.0;  ///< 0: none are spread
  double next_mark_ = 0.0;      ///< window
  transport::Clock::time_point last_ = transport::Clock::now();
  std::atomic<unsigned> written_ = 0;
  bool now_ = false;
  bool ending_ = false;
  bool asked_ = false;         ///< for the last one
  unsigned written_then_ = 0;  ///< when it was
  transport::Deadline patience_{};
};

}  // namespace grainstep::orchestrator
