/// @file Looks through any message for numbers that are not finite.
#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>

namespace grainstep::ledger {

/// Path and value of the first double that is infinite or not a number, e.g. "energy.kinetic = nan"; nullopt: none.
[[nodiscard]] std::optional<std::string> first_not_finite(const google::protobuf::Message& message);

}  // namespace grainstep::ledger
