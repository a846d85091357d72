/// @file A text in quotation marks, as YAML reads it.
#pragma once

#include <string>

namespace grainstep::scene {

[[nodiscard]] std::string quoted(const std::string& text);

}  // namespace grainstep::scene
