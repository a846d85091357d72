/// @file What is wrong with a study, collected: each line once, because one slip may meet every point.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "declare/problems.hpp"

namespace grainstep::study {

class Complaints {
 public:
  void add(const declare::Origin& origin, const std::string& path, const std::string& text) {
    add(declare::problem_line(origin, path, text));
  }

  /// An error's text; its lines are separate problems.
  void add(const std::string& text) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
    }
  }

  [[nodiscard]] bool empty() const noexcept { return lines_.empty(); }

  void throw_if_any() const {
    constexpr std::size_t most = 50;
    std::string all;
    for (std::size_t i = 0; i < std::min(most, lines_.size()); ++i) all += (i == 0 ? "" : "\n") + lines_[i];
    if (lines_.size() > most) all += "\nand " + std::to_string(lines_.size() - most) + " more";
    if (!empty()) throw InputError(all);
  }

 private:
  std::vector<std::string> lines_;
};

}  // namespace grainstep::study
