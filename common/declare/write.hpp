/// @file A declared message as YAML.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace grainstep::declare {

/// Everything `message` says, defaults included, in SI with units. Deterministic; what reads it gives the same message
/// again.
[[nodiscard]] std::string to_yaml(const google::protobuf::Message& message);

}  // namespace grainstep::declare
