/// @file One place to wait: channels, ended processes and signals. Blocks in poll(), never spins, never without
/// deadline.
#pragma once

#include <functional>
#include <vector>

#include "transport/channel.hpp"

namespace grainstep::orchestrator {

class EventLoop {
 public:
  using Action = std::function<void()>;

  /// `action` runs inside wait() whenever `fd` is readable; it must take what made it so. It may throw.
  void add(int fd, Action action);

  /// Forgets `fd`; may be called by its own action.
  void remove(int fd);

  /// A channel only wakes wait() up.
  void add(const transport::Channel& channel);

  /// Returns at the deadline or earlier, after the actions of everything that was readable.
  void wait(transport::Deadline deadline);

 private:
  struct Source {
    int fd;
    Action action;
  };
  std::vector<Source> sources_;
};

}  // namespace grainstep::orchestrator
