/// @file What a run can go on from, in its directory: one file for each checkpoint, of named parts with a checksum
/// each. A file is whole and durable before it has its name, and the two latest are kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace grainstep::results {

using Parts = std::map<std::string, std::string>;

class Checkpoints {
 public:
  /// `directory`: of all checkpoints of a run; made with the first of them.
  explicit Checkpoints(std::filesystem::path directory) : directory_(std::move(directory)) {}

  /// Of the end of window n. Then removes all but the two latest. OutputError; what was there before stays.
  void write(std::uint64_t window, Parts parts) const;

  /// Windows, in order.
  [[nodiscard]] std::vector<std::uint64_t> windows() const;

  /// InputError where it is not there, damaged, or none.
  [[nodiscard]] Parts read(std::uint64_t window) const;

  /// Whether a file of this name is one.
  [[nodiscard]] static bool is_one(const std::string& file) { return window_of(file).has_value(); }

 private:
  [[nodiscard]] static std::optional<std::uint64_t> window_of(std::string_view file);
  [[nodiscard]] std::filesystem::path file(std::uint64_t window) const;

  std::filesystem::path directory_;
};

}  // namespace grainstep::results
