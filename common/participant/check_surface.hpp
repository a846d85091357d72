/// @file A surface that came over the wire, before its numbers become indices and divisors: one rule for the
/// orchestrator, whom a structure tells its surface, and for impactors, who are told it.
#pragma once

#include <optional>
#include <string>

#include "grainstep/wire.pb.h"

namespace grainstep::participant {

/// What is wrong with it in a run of `dimension` (2 or 3); nothing if nothing is. The text goes on behind the name of
/// the message's field: ".velocity holds 3 numbers, ...".
[[nodiscard]] std::optional<std::string> surface_problem(const wire::Surface& surface, unsigned dimension);

}  // namespace grainstep::participant
