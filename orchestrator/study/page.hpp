/// @file A study as a page of the documentation: its text, its pictures, what was stated and what came out, its table.
#pragma once

#include <filesystem>
#include <string>

#include "orchestrator/study/tables.hpp"

namespace grainstep::study {

/// Markdown. @param command that makes the page again.
/// @param picture_of the link to the picture of this name, relative to the page; empty: there is none.
[[nodiscard]] std::string page_markdown(const Report& report, const std::string& command,
                                        const std::function<std::string(const std::string&)>& picture_of);

/// Writes the page, and copies the pictures to `images/` beside it, as <page>.png or <page>-<plot>.png.
/// @throws OutputError
void write_page(const Report& report, const std::filesystem::path& root, const std::filesystem::path& page,
                const std::string& command);

}  // namespace grainstep::study
