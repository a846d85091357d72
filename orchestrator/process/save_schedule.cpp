#include "orchestrator/process/save_schedule.hpp"

#include <utility>

#include "orchestrator/process/interrupted.hpp"

namespace grainstep::orchestrator {
namespace {

/// Container engines and batch systems give a process ten seconds or more between SIGTERM and SIGKILL.
constexpr auto patience_with_the_last = std::chrono::seconds(5);

}  // namespace

bool SaveSchedule::due() {
  const auto now = transport::Clock::now();
  if (ending_) {
    if (written_ != written_then_ || now >= patience_) throw Interrupted();
    return !std::exchange(asked_, true);
  }
  if (std::exchange(now_, false)) return true;
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
