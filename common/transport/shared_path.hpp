/// @file The short way between two participants on one host: a ring for each direction in shared memory, to which the
/// orchestrator listens (proto/README.md, "The path of data").
#pragma once

#include <cstdint>
#include <filesystem>

#include "transport/shared_memory.hpp"
#include "transport/shared_ring.hpp"

namespace grainstep::transport {

class SharedPath {
 public:
  enum class Way { forces, kinematics };

  /// As many slots as there is room for, for messages of up to `longest` bytes. std::system_error as SharedMemory.
  [[nodiscard]] static SharedPath create(std::uint64_t longest);

  /// As a participant, who is counted. std::system_error where it cannot be opened, std::range_error where it is not
  /// what another build of this version makes.
  [[nodiscard]] static SharedPath open(const std::filesystem::path& file);

  [[nodiscard]] SharedRing ring(Way way) const;
  [[nodiscard]] const std::filesystem::path& file() const { return memory_.file(); }

  /// For the orchestrator: takes the name away as soon as both participants are there.
  void close_door();

 private:
  struct Header;
  explicit SharedPath(SharedMemory memory) : memory_(std::move(memory)) {}
  [[nodiscard]] Header& header() const;

  SharedMemory memory_;
  RingShape shape_;
  bool open_ = true;
};

}  // namespace grainstep::transport
