/// @file What a fuzz program has done, printed at its end.
#pragma once

#include <cstdint>

namespace grainstep::fuzz {

struct Statistics {
  std::uint64_t inputs = 0;
  std::uint64_t messages = 0;  ///< that reached the code under test
  std::uint64_t complete = 0;  ///< inputs after which the conversation came to its good end
  std::uint64_t blamed = 0;    ///< inputs that ended with an error which names the liar, or what he asked for
  std::uint64_t skipped = 0;   ///< models that are merely large: they were not computed
};

/// Of this program. The first call has them printed when the program ends.
[[nodiscard]] Statistics& statistics();

}  // namespace grainstep::fuzz
