/// @file Settings that no declaration knows: whatever keys somebody's own program reads, passed on as they are
/// (google.protobuf.Struct). A number that carries a unit is a text: only who reads it knows what it is a number of.
#pragma once

#include <google/protobuf/struct.pb.h>

#include <string>

#include "declare/tree.hpp"

namespace grainstep::declare {

/// `tree` is a map. InputError for a number that is none a double can hold.
[[nodiscard]] google::protobuf::Struct free_settings(const Tree& tree);

/// One line of YAML that reads back as the same settings; their keys in alphabetical order.
[[nodiscard]] std::string to_yaml(const google::protobuf::Struct& settings);

}  // namespace grainstep::declare
