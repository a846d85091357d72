/// @file The participants that run on this host: started, watched, and gone when this object is.
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "grainstep/wire.pb.h"
#include "orchestrator/event_loop.hpp"
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

  /// Throws PeerError once for a process that has ended although its side is not `finished`. What it said last is given
  /// a moment to arrive: a participant that fails says why before it ends.
  struct Finished {
    bool impactor;
    bool structure;
  };
  void watch(Finished finished);

  /// How the process of a lost peer ended, and what it wrote last; empty when it is not one of ours.
  [[nodiscard]] std::string account_of(const std::string& peer);

  /// Waits for all to end by themselves, then ends what is left.
  void end_all(std::chrono::milliseconds grace);

 private:
  struct Child {
    std::unique_ptr<process::ChildProcess> process;
    std::optional<std::chrono::steady_clock::time_point> ended;
    bool told = false;
  };
  [[nodiscard]] Child& child(wire::Role role) { return children_[role == wire::IMPACTOR ? 0 : 1]; }
  void watch(wire::Role role, bool finished);

  EventLoop& loop_;
  std::array<Child, 2> children_;
};

}  // namespace grainstep::orchestrator
