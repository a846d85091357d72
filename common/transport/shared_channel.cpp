#include "transport/shared_channel.hpp"

#include <algorithm>
#include <stdexcept>
#include <thread>

#include "base/assert.hpp"
#include "base/error.hpp"

namespace grainstep::transport {
namespace {

// To be woken takes longer than a short wait (docs/decisions/0020-short-path-of-data.md). But who spins takes a core
// from who computes: only where there are two, and rarely where it is in vain. A spin is longer than a wake-up: else
// one side that slept once would have the other one miss, sleep, and be late in turn, for ever.
constexpr auto longest_spin = std::chrono::microseconds(60);
constexpr unsigned most_misses = 8;
constexpr unsigned pause = 32;  // waits

constexpr auto between_looks = std::chrono::milliseconds(5);
constexpr auto for_room = std::chrono::microseconds(100);

void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

SharedPath::Way other(SharedPath::Way way) {
  return way == SharedPath::Way::forces ? SharedPath::Way::kinematics : SharedPath::Way::forces;
}

}  // namespace

SharedChannel::SharedChannel(const SharedPath& path, SharedPath::Way out, std::string peer, WhileWaiting look)
    : out_(path.ring(out)),
      in_(path.ring(other(out))),
      reader_(SharedRing::peer),
      peer_(std::move(peer)),
      look_(std::move(look)),
      may_spin_(std::thread::hardware_concurrency() >= 2) {}

SharedChannel::SharedChannel(const SharedPath& path, SharedPath::Way heard, std::string peer)
    : in_(path.ring(heard)), reader_(SharedRing::listener), peer_(std::move(peer)), may_spin_(false) {}

bool SharedChannel::take(Bytes& message) {
  try {
    return in_.read(reader_, message);
  } catch (const std::range_error& error) {
    throw PeerError(peer_, std::string("shared memory is damaged: ") + error.what());
  }
}

bool SharedChannel::worth_a_spin() {
  if (!may_spin_) return false;
  if (sleep_for_ == 0) return true;
  --sleep_for_;
  return false;
}

bool SharedChannel::spin(Bytes& message) {
  const Deadline end = Clock::now() + longest_spin;
  do {
    for (int i = 0; i < 16; ++i) {
      if (take(message)) {
        misses_ = 0;
        return true;
      }
      relax();
    }
  } while (Clock::now() < end);
  if (++misses_ >= most_misses) sleep_for_ = pause;
  return false;
}

bool SharedChannel::receive(Bytes& message, Deadline deadline) {
  if (take(message)) return true;
  if (reader_ == SharedRing::listener) return false;
  if (worth_a_spin() && spin(message)) return true;
  while (true) {
    const Deadline now = Clock::now();
    if (now >= deadline) return false;
    const bool soon = in_.sleep(std::min(deadline, now + between_looks));
    if (take(message)) return true;
    if (soon && may_spin_ && spin(message)) return true;  // it knocked
    look_();
  }
}

void SharedChannel::knock() { out_->knock(); }

void SharedChannel::send(std::span<const std::byte> message) {
  GS_ASSERT(out_, "who listens says nothing");
  while (!out_->write(message)) {
    look_();
    std::this_thread::sleep_for(for_room);
  }
}

}  // namespace grainstep::transport
