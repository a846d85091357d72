/// @file "Did you mean ...?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grainstep::declare {

/// The known word that `written` is most likely a slip of (insertions, deletions, changes, neighbours swapped), or
/// an empty string if none is near.
[[nodiscard]] std::string nearest_word(std::string_view written, const std::vector<std::string>& known);

/// "; did you mean 'diameter'?", or an empty string.
[[nodiscard]] std::string hint(std::string_view written, const std::vector<std::string>& known);

/// "a, b, c"
[[nodiscard]] std::string join_words(const std::vector<std::string>& words);

}  // namespace grainstep::declare
