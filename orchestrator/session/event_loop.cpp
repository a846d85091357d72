#include "orchestrator/session/event_loop.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>

#include "base/assert.hpp"

namespace grainstep::orchestrator {

void EventLoop::add(int fd, Action action) { sources_.push_back({++last_id_, fd, std::move(action)}); }

void EventLoop::add(const transport::Channel& channel) {
  GS_ASSERT(channel.wakeup() >= 0, "the orchestrator needs channels that can be polled");
  add(channel.wakeup(), nullptr);
}

void EventLoop::remove(int fd) {
  std::erase_if(sources_, [fd](const Source& source) { return source.fd == fd; });
}

void EventLoop::act(std::uint64_t id) {
  const auto source = std::ranges::find(sources_, id, &Source::id);
  if (source == sources_.end() || !source->action) return;  // removed by an earlier action
  const Action action = source->action;                     // it may remove itself
  action();
}

void EventLoop::note_time() {
  const transport::Clock::time_point now = transport::Clock::now();
  if (now - awake_ > longest_turn) standstill_ = {now, now - awake_};
  awake_ = now;
}

std::chrono::duration<double> EventLoop::standstill() const {
  using namespace std::chrono_literals;
  const bool recent = standstill_ && transport::Clock::now() - standstill_->end < 10s;
  return recent ? standstill_->length : 0s;
}

void EventLoop::wait(transport::Deadline deadline) {
  using std::chrono::milliseconds;
  note_time();
  const auto left = std::chrono::ceil<milliseconds>(deadline - transport::Clock::now());
  const int timeout = static_cast<int>(std::clamp(left, milliseconds(0), milliseconds(1000)).count());
  std::vector<pollfd> fds;
  std::vector<std::uint64_t> ids;
  for (const Source& source : sources_) {
    fds.push_back({.fd = source.fd, .events = POLLIN, .revents = 0});
    ids.push_back(source.id);
  }
  const int ready = ::poll(fds.data(), fds.size(), timeout);
  if (ready < 0 && errno != EINTR) {
    throw std::system_error(errno, std::generic_category(), "poll");
  }
  note_time();
  for (std::size_t i = 0; ready > 0 && i < fds.size(); ++i) {
    if (fds[i].revents != 0) act(ids[i]);
  }
}

}  // namespace grainstep::orchestrator
