#include "orchestrator/session/listener.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace grainstep::orchestrator {
namespace {

using transport::SharedPath;

constexpr long tick_ns = 1'000'000;

/// Of a Kinematics, the longer one: two arrays, and what stands around them. A message that is too long by a few values
/// still gets through, and is refused by whoever reads it.
std::uint64_t longest_message(std::uint64_t values) { return 2 * sizeof(double) * (values + 64) + 256; }

}  // namespace

Listener::Listener(std::uint64_t values)
    : path_(SharedPath::create(longest_message(values))),
      forces_(path_, SharedPath::Way::forces, "impactor"),
      kinematics_(path_, SharedPath::Way::kinematics, "structure") {}

Ticking::Ticking(EventLoop& loop, std::function<void()> action)
    : loop_(loop), timer_(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK)) {
  const itimerspec every{.it_interval = {0, tick_ns}, .it_value = {0, tick_ns}};
  if (timer_ < 0 || ::timerfd_settime(timer_, 0, &every, nullptr) != 0) {
    throw std::system_error(errno, std::generic_category(), "timerfd");
  }
  loop_.add(timer_, [timer = timer_, action = std::move(action)] {
    std::uint64_t ticks = 0;
    if (::read(timer, &ticks, sizeof ticks) == sizeof ticks) action();
  });
}

Ticking::~Ticking() {
  loop_.remove(timer_);
  ::close(timer_);
}

}  // namespace grainstep::orchestrator
