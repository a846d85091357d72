/// @file How the programs of the orchestrator end: with a code for each kind of end, and one line about a bad one.
#pragma once

#include <functional>

namespace grainstep::orchestrator {

/// What `act` returns, or the exit code of the exception that it throws (base/error.hpp).
[[nodiscard]] int end_of_program(const std::function<int()>& act);

}  // namespace grainstep::orchestrator
