/// @file What libyaml refused, in words that say what to do.
#pragma once

#include <yaml.h>

#include <string>

namespace grainstep::declare {

/// "file:line: not YAML: ..." for a parser whose last call failed. `text` is all that it reads.
[[nodiscard]] std::string yaml_problem(const yaml_parser_t& parser, const std::string& text, const std::string& source);

}  // namespace grainstep::declare
