/// @file The orchestrator's ear on the short path of data: Forces and Kinematics pass between the participants in
/// shared memory, and are heard here, every one, a moment later.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "orchestrator/session/event_loop.hpp"
#include "transport/shared_channel.hpp"
#include "wire/message_channel.hpp"

namespace grainstep::orchestrator {

class Listener {
 public:
  /// For a surface of `values` coordinates. std::system_error where this host has no memory to share.
  explicit Listener(std::uint64_t values);

  /// What Start names.
  [[nodiscard]] const std::filesystem::path& file() const { return path_.file(); }

  /// One of the two ways.
  struct Way {
    Way(const transport::SharedPath& path, transport::SharedPath::Way way, const char* writer)
        : channel(path, way, writer), messages(channel, writer) {}
    transport::SharedChannel channel;
    wire::MessageChannel messages;
  };
  [[nodiscard]] Way& forces() { return forces_; }
  [[nodiscard]] Way& kinematics() { return kinematics_; }

  /// To be called now and then: nothing of the path stays in the file system once both sides have found it.
  void close_door() { path_.close_door(); }

 private:
  transport::SharedPath path_;
  Way forces_;
  Way kinematics_;
};

/// Calls back from an event loop every millisecond as long as it lives. The memory wakes nobody who listens: that
/// would cost its writer more than all the rest of an exchange.
class Ticking {
 public:
  Ticking(EventLoop& loop, std::function<void()> action);
  Ticking(const Ticking&) = delete;
  Ticking& operator=(const Ticking&) = delete;
  ~Ticking();

 private:
  EventLoop& loop_;
  int timer_;
};

}  // namespace grainstep::orchestrator
