/// @file What a study states, against what its runs gave.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "orchestrator/study/names.hpp"

namespace grainstep::study {

struct Verdict {
  enum class State {
    holds,
    fails,
    reported,  ///< nothing was expected
    open       ///< its runs are not all done
  };
  State state = State::open;
  double value = std::numeric_limits<double>::quiet_NaN();
  std::string wanted;  ///< "0.137 +- 2%", "at least 0.1"; empty: nothing
};

/// In the order of the study's findings. A finding is open while a point that it looks at is; a failed point makes it
/// fail.
[[nodiscard]] std::vector<Verdict> judge(const Plan& plan, const std::vector<Outcome>& outcomes,
                                         const Numbers& numbers);

[[nodiscard]] const char* state_name(Verdict::State state);

}  // namespace grainstep::study
