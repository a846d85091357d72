/// @file Everything that is wrong with an input, collected and told at once: one line each.
#pragma once

#include <string>
#include <vector>

#include "declare/tree.hpp"

namespace grainstep::declare {

/// "configs/x.yaml:12: impactor.slug.speed: 'fast' is not a number; ..."
[[nodiscard]] std::string problem_line(const Origin& origin, const std::string& path, const std::string& text);

class Problems {
 public:
  /// `path` may be empty: the whole file.
  void add(const Origin& origin, const std::string& path, const std::string& text);

  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }

  /// @throws InputError with all problems, in the order in which they were found, if there are any.
  void throw_if_any() const;

 private:
  std::vector<std::string> lines_;
  std::size_t count_ = 0;
};

}  // namespace grainstep::declare
