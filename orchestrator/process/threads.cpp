#include "orchestrator/process/threads.hpp"

#include <algorithm>

namespace grainstep::orchestrator {
namespace {

constexpr double next_to_nothing = 0.1;  // of what the other side's last thread does

}  // namespace

ThreadShares share_threads(int threads, const Cost& cost, const TakesThreads& takes) {
  ThreadShares out;
  const double more = std::max(cost.impactor, cost.structure);
  const double less = std::min(cost.impactor, cost.structure);
  const int to_share = less < next_to_nothing * more / threads ? threads + 1 : threads;
  for (int given = 2; given < to_share; ++given) {
    const double impactor = takes.impactor ? cost.impactor / out.impactor : 0.0;
    const double structure = takes.structure ? cost.structure / out.structure : 0.0;
    if (impactor == 0.0 && structure == 0.0) break;
    ++(impactor >= structure ? out.impactor : out.structure);
  }
  return out;
}

}  // namespace grainstep::orchestrator
