/// @file A participant's end of the way that Forces and Kinematics take past the orchestrator, if Start names one
/// (proto/README.md, "The path of data").
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "grainstep/wire.pb.h"
#include "wire/message_channel.hpp"

namespace grainstep::participant {

class DataPath {
 public:
  DataPath() = default;
  DataPath(const DataPath&) = delete;
  DataPath& operator=(const DataPath&) = delete;
  virtual ~DataPath() = default;

  [[nodiscard]] virtual wire::MessageChannel& messages() = 0;

  /// Data will be sent within microseconds.
  virtual void knock() {}

  /// Whether the orchestrator hears what passes here only if it is sent there, too.
  [[nodiscard]] virtual bool wants_copies() const = 0;
};

/// Called every few milliseconds while data are waited for; what it throws passes through.
using WhileWaiting = std::function<void()>;

/// The other side's name in errors.
[[nodiscard]] inline const char* other_side(wire::Role role) {
  return role == wire::IMPACTOR ? "structure" : "impactor";
}

inline constexpr const char* shared_memory_capability = "shared_memory";  ///< the word in Hello

/// InputError where the file cannot be opened: the sides are not on one host after all.
[[nodiscard]] std::unique_ptr<DataPath> share_memory(const std::filesystem::path& file, wire::Role role,
                                                     WhileWaiting look);

}  // namespace grainstep::participant
