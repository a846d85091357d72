/// @file A directory of its own for each test, removed at the end; and readers that share no code with the writers.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include "base/temporary_directory.hpp"

namespace grainstep::results {

using Scratch = TemporaryDirectory;

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
