/// @file A Start that came over the wire, before a participant divides by its numbers and counts up to them.
#pragma once

#include <optional>
#include <string>

#include "grainstep/wire.pb.h"

namespace grainstep::participant {

/// What is wrong with it; nothing if nothing is.
[[nodiscard]] std::optional<std::string> start_problem(const wire::Start& start);

}  // namespace grainstep::participant
