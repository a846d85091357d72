/// @file YAML text to a Tree. Total: any bytes give a tree or an InputError, in bounded memory.
#pragma once

#include <string>

#include "declare/problems.hpp"
#include "declare/tree.hpp"

namespace grainstep::declare {

/// Largest accepted file, bytes.
inline constexpr std::size_t largest_file = 256UL * 1024;

/// Parses one document. An empty one is null. Duplicate keys go to `problems`, with the first one kept.
/// @param source how `text` is called in messages and provenance.
/// @throws InputError ("file:line: what is wrong") if `text` is not one YAML document within the limits.
[[nodiscard]] Tree parse_yaml(const std::string& text, const std::string& source, Problems& problems);

}  // namespace grainstep::declare
