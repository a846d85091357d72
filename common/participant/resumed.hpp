/// @file How an impactor's run begins: at the start, or after the window whose state it was given.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "participant/backend.hpp"

namespace grainstep::participant {

struct Resumed {
  std::uint64_t window = 0;  ///< all of it is done
  std::string_view state;    ///< as ImpactorLink::send_state() was given it; valid as long as the link
};

/// nullopt: the run begins at the start. InputError where Start and the state do not say the same.
[[nodiscard]] inline std::optional<Resumed> resumed(const wire::Start& start, const ImpactorLink& link) {
  const std::optional<std::string_view> state = link.state();
  if ((start.first_window() != 0) != state.has_value()) {
    throw InputError("Start.first_window is " + std::to_string(start.first_window()) +
                     ": a run goes on with a state, and begins at 0 without one");
  }
  if (!state) return std::nullopt;
  return Resumed{.window = start.first_window() - 1, .state = *state};
}

}  // namespace grainstep::participant
