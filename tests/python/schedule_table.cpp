/// schedule-table WINDOWS REPORT_EVERY SNAPSHOT_EVERY: the windows at which something is due, a line each: the window,
/// then 1 or 0 for report and snapshot. What the Python package is compared with.
#include <cstdio>
#include <cstdlib>

#include "participant/schedule.hpp"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  grainstep::wire::Start start;
  start.set_windows(std::strtoull(argv[1], nullptr, 10));
  start.set_report_every(std::strtod(argv[2], nullptr));
  start.set_snapshot_every(std::strtod(argv[3], nullptr));
  for (std::uint64_t window = 0; window <= start.windows(); ++window) {
    const grainstep::participant::Due due = grainstep::participant::due_at(start, window);
    if (due.report || due.snapshot) {
      std::printf("%llu %d %d\n", static_cast<unsigned long long>(window), due.report ? 1 : 0, due.snapshot ? 1 : 0);
    }
  }
  return 0;
}
