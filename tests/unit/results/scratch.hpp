/// @file A directory of its own for each test, removed at the end; and readers that share no code with the writers.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace grainstep::results {

class Scratch {
 public:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / "grainstep-results-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What `readers.py COMMAND ARGUMENT` prints (h5py, VTK's own readers).
inline std::string read_with(const std::string& command, const std::filesystem::path& argument) {
  const std::string line = std::string(PYTHON) + " " + READERS + " " + command + " '" + argument.string() + "' 2>&1";
  FILE* pipe = ::popen(line.c_str(), "r");
  std::string out;
  std::array<char, 4096> buffer{};
  while (pipe != nullptr && std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
    out += buffer.data();
  }
  EXPECT_EQ(::pclose(pipe), 0) << out;
  return out;
}

}  // namespace grainstep::results
