#include "orchestrator/process/save_schedule.hpp"

#include <cmath>
#include <utility>

#include "orchestrator/process/interrupted.hpp"

namespace grainstep::orchestrator {
namespace {

/// Container engines and batch systems give a process ten seconds or more between SIGTERM and SIGKILL.
constexpr auto patience_with_the_last = std::chrono::seconds(5);

}  // namespace

void SaveSchedule::spread(std::uint32_t count, std::uint64_t windows, std::uint64_t done) {
  every_windows_ = static_cast<double>(windows) / (static_cast<double>(count) + 1.0);  // the end needs none
  next_mark_ = every_windows_;
  static_cast<void>(passes_a_mark(done));
}

bool SaveSchedule::passes_a_mark(std::uint64_t window) {
  if (!(every_windows_ > 0.0) || static_cast<double>(window) < next_mark_) return false;
  next_mark_ = every_windows_ * (std::floor(static_cast<double>(window) / every_windows_) + 1.0);
  return true;
}

bool SaveSchedule::due(std::uint64_t window) {
  const auto now = transport::Clock::now();
  if (ending_) {
    if (written_ != written_then_ || now >= patience_) throw Interrupted();
    return !std::exchange(asked_, true);
  }
  if (std::exchange(now_, false)) return true;
  if (passes_a_mark(window)) return true;
  if (!(every_s_ > 0.0) || now - last_ < std::chrono::duration<double>(every_s_)) return false;
  last_ = now;
  return true;
}

void SaveSchedule::end_after_next() {
  ending_ = true;
  written_then_ = written_;
  patience_ = transport::Clock::now() + patience_with_the_last;
}

}  // namespace grainstep::orchestrator
