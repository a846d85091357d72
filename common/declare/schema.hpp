/// @file A JSON Schema (draft 7, what editors understand) of a scene, from its declaration.
#pragma once

#include <google/protobuf/descriptor.h>

#include <string>

namespace grainstep::declare {

/// Names, types, words, bounds of bare numbers, defaults and texts. It does not ask for required keys: a file that
/// includes another, and one that is meant to be included, need not have them; the loader sees the merged scene and
/// asks.
[[nodiscard]] std::string json_schema(const google::protobuf::Descriptor& root);

}  // namespace grainstep::declare
