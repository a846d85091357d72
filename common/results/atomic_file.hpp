/// @file Small files that are whole at any moment: written beside their place and renamed into it.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace grainstep::results {

/// Throws OutputError with the path and the system's reason; the old file, if any, is then still there.
void write_atomically(const std::filesystem::path& path, std::string_view contents);

/// The same, and no loss of power undoes it.
void write_durably(const std::filesystem::path& path, std::string_view contents);

}  // namespace grainstep::results
