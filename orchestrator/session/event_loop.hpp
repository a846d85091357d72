/// @file One place to wait: channels, ended processes and signals. Blocks in poll(), never spins, never without
/// deadline.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "transport/channel.hpp"

namespace grainstep::orchestrator {

class EventLoop {
 public:
  using Action = std::function<void()>;

  /// `action` runs inside wait() whenever `fd` is readable; it must take what made it so. It may throw, add and remove.
  void add(int fd, Action action);

  /// Forgets `fd`, whose action does not run any more. To be called before `fd` is closed.
  void remove(int fd);

  /// How many are waited for. poll() refuses more than a process may have open.
  [[nodiscard]] std::size_t size() const { return sources_.size(); }

  /// A channel only wakes wait() up.
  void add(const transport::Channel& channel);

  /// Returns at the deadline or earlier, after the actions of everything that was readable.
  void wait(transport::Deadline deadline);

  /// Whoever waits next has worked until now, and was not held up.
  void wake() { awake_ = transport::Clock::now(); }

  /// s: how long this process did not get to run lately although it had to, because it was stopped or the machine stood
  /// still; 0: it ran. Peers take such a process for lost, and it takes them for lost.
  [[nodiscard]] std::chrono::duration<double> standstill() const;

 private:
  /// Waits last a second at most, and turns between them milliseconds.
  static constexpr std::chrono::milliseconds longest_turn{2200};
  struct Standstill {
    transport::Clock::time_point end;
    std::chrono::duration<double> length;
  };

  void note_time();

  struct Source {
    std::uint64_t id;  ///< a descriptor's number may be given to another before its turn comes
    int fd;
    Action action;
  };
  void act(std::uint64_t id);

  std::vector<Source> sources_;
  std::uint64_t last_id_ = 0;
  transport::Clock::time_point awake_ = transport::Clock::now();
  std::optional<Standstill> standstill_;
};

}  // namespace grainstep::orchestrator
