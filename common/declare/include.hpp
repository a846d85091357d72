/// @file A file and everything it includes, merged.
#pragma once

#include <filesystem>

#include "declare/problems.hpp"
#include "declare/tree.hpp"

namespace grainstep::declare {

/// Reads `path`. Its top-level `include` (a path or a list of them, relative to the including file) is read first, in
/// order; the keys of the file itself lie on top. The result has no `include` key and is a map.
/// @throws InputError if a file cannot be read, is not YAML, or includes itself.
[[nodiscard]] Tree read_file(const std::filesystem::path& path, Problems& problems);

}  // namespace grainstep::declare
