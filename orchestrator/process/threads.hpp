/// @file How many threads each side gets.
#pragma once

namespace grainstep::orchestrator {

/// Seconds that each side computes on one core.
struct Cost {
  double impactor = 0.0;
  double structure = 0.0;
};

struct ThreadShares {
  int impactor = 1;
  int structure = 1;
};

/// Which sides have the capability `threads`.
struct TakesThreads {
  bool impactor = false;
  bool structure = false;
};

/// `threads`, at least 1, for both sides together, so that the slower one is as fast as can be. Each has one; a side
/// with next to no work beside the other's has one more than were given, for it does not need a core of its own.
[[nodiscard]] ThreadShares share_threads(int threads, const Cost& cost, const TakesThreads& takes);

}  // namespace grainstep::orchestrator
