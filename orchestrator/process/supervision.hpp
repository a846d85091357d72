/// @file The participants that run on this host: started, watched, and gone when this object is.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "grainstep/wire.pb.h"
#include "orchestrator/session/event_loop.hpp"
#include "process/child_process.hpp"

namespace grainstep::orchestrator {

class Supervision {
 public:
  explicit Supervision(EventLoop& loop) : loop_(loop) {}
  Supervision(const Supervision&) = delete;
  Supervision& operator=(const Supervision&) = delete;
  ~Supervision() { end_all(std::chrono::milliseconds(0)); }

  /// From the main thread. InputError when the program or its log cannot be used.
  void start(wire::Role role, const process::Command& command, const std::filesystem::path& log);

  /// How far a side has come in its conversation.
  struct Side {
    bool introduced;
    bool finished;
  };
  struct Sides {
    Side impactor;
    Side structure;
  };
  /// Throws PeerError once for a process that has ended although its side is not finished, and for one that has been
  /// stopped (SIGSTOP) for some seconds. What it said last is given time to arrive: a participant that fails says why
  /// before it ends, and a connection that was made tells of its end by itself.
  void watch(const Sides& sides);

  /// How the process of a lost peer ended, and what it wrote last; empty when it is not one of ours.
  [[nodiscard]] std::string account_of(const std::string& peer);

  /// Waits for all to end by themselves, then ends what is left.
  void end_all(std::chrono::milliseconds grace) noexcept;

 private:
  struct Child {
    std::unique_ptr<process::ChildProcess> process;
    std::optional<std::chrono::steady_clock::time_point> ended;
    std::optional<std::chrono::steady_clock::time_point> stopped;  ///< when that was seen first
    bool told = false;
  };
  [[nodiscard]] Child& child(wire::Role role) { return children_[role == wire::IMPACTOR ? 0 : 1]; }
  void watch_end(wire::Role role, Side side);
  void watch_standstill(wire::Role role, Side side);

  EventLoop& loop_;
  std::array<Child, 2> children_;
  std::chrono::steady_clock::time_point next_look_ = std::chrono::steady_clock::now();
};

}  // namespace grainstep::orchestrator
