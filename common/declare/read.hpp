/// @file A Tree to any message that is declared with options.proto, by reflection.
#pragma once

#include <google/protobuf/message.h>

#include <memory>
#include <string>

#include "declare/problems.hpp"
#include "declare/tree.hpp"

namespace grainstep::declare {

/// Fills `message` from `tree`: every key known, of its type, within its range; required ones present; the defaults of
/// absent ones filled in. What is wrong goes to `problems`; `message` is then incomplete.
/// @param path of `tree` in its file, for messages; empty: the root.
void read_message(const Tree& tree, const std::string& path, google::protobuf::Message& message, Problems& problems);

/// What an empty map of keys would give; required keys are then missing.
[[nodiscard]] std::unique_ptr<google::protobuf::Message> defaults_of(const google::protobuf::Message& kind);

}  // namespace grainstep::declare
