/// @file Memory that processes of one host share, under a name that only its owner's processes may open.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "base/owned_directory.hpp"

namespace grainstep::transport {

class SharedMemory {
 public:
  /// All zero, in a private directory under /dev/shm; every page is there from the beginning, so that a write never
  /// finds the memory full. std::system_error where the host has none, or not so much.
  [[nodiscard]] static SharedMemory create(std::size_t bytes);

  /// What another process has created. std::system_error where it is not there or cannot be opened.
  [[nodiscard]] static SharedMemory open(const std::filesystem::path& file);

  SharedMemory(SharedMemory&& other) noexcept;
  SharedMemory& operator=(SharedMemory&&) = delete;
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;
  ~SharedMemory();

  [[nodiscard]] std::span<std::byte> bytes() const { return bytes_; }

  /// What the others open.
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

  /// Takes the name away, once all who need it have opened it: whatever ends this process then, nothing stays. For its
  /// creator; without effect after the first time.
  void remove_name() noexcept;

 private:
  SharedMemory(std::span<std::byte> bytes, std::filesystem::path file, std::optional<OwnedDirectory> home);

  std::span<std::byte> bytes_;
  std::filesystem::path file_;
  std::optional<OwnedDirectory> home_;  ///< of its creator
};

}  // namespace grainstep::transport
