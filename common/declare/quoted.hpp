/// @file A text in quotation marks, as YAML reads it.
#pragma once

#include <string>

namespace grainstep::declare {

[[nodiscard]] std::string quoted(const std::string& text);

}  // namespace grainstep::declare
