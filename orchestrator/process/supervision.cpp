#include "orchestrator/process/supervision.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "orchestrator/session/peer.hpp"

namespace grainstep::orchestrator {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// What a process that never came so far as to say Hello can still have to say.
constexpr milliseconds last_words{500};
// The channel of one that did tells of its end when all is read; on a machine with much to do that takes its time.
constexpr milliseconds last_words_of_a_peer{10'000};
// A lost one's process is nearly always on its way out.
constexpr milliseconds end_of_a_lost_one{2000};
// Somebody stopped it, and did not let it go on: a debugger, a batch system that suspends jobs.
constexpr milliseconds longest_standstill{2500};
constexpr milliseconds look_interval{500};
constexpr std::size_t tail_lines = 8;

}  // namespace

void Supervision::start(wire::Role role, const process::Command& command, const std::filesystem::path& log) {
  Child& started = child(role);
  started.process = std::make_unique<process::ChildProcess>(name_of(role), command, log);
  const int descriptor = started.process->descriptor();
  loop_.add(descriptor, [this, &started, descriptor] {
    started.ended = steady_clock::now();
    loop_.remove(descriptor);
  });
}

void Supervision::watch_end(wire::Role role, Side side) {
  Child& watched = child(role);
  const milliseconds moment = side.introduced ? last_words_of_a_peer : last_words;
  if (side.finished || watched.told || !watched.ended || steady_clock::now() - *watched.ended < moment) {
    return;
  }
  watched.told = true;
  throw PeerError(name_of(role), "its process ended before the run did");
}

void Supervision::watch_standstill(wire::Role role, Side side) {
  Child& watched = child(role);
  if (side.finished || watched.told || !watched.process || !watched.process->is_stopped()) {
    watched.stopped.reset();
    return;
  }
  const auto now = steady_clock::now();
  if (!watched.stopped) watched.stopped = now;
  if (now - *watched.stopped < longest_standstill) return;
  watched.told = true;
  throw PeerError(name_of(role), "its process stands still");
}

void Supervision::watch(const Sides& sides) {
  watch_end(wire::IMPACTOR, sides.impactor);
  watch_end(wire::STRUCTURE, sides.structure);
  // Called between any two messages: a look costs a call of the system.
  if (steady_clock::now() < next_look_) return;
  next_look_ = steady_clock::now() + look_interval;
  watch_standstill(wire::IMPACTOR, sides.impactor);
  watch_standstill(wire::STRUCTURE, sides.structure);
}

std::string Supervision::account_of(const std::string& peer) {
  for (const Child& candidate : children_) {
    if (candidate.process && candidate.process->name() == peer) {
      process::ChildProcess& process = *candidate.process;
      if (!process.is_stopped()) static_cast<void>(process.wait(end_of_a_lost_one));
      std::string text = "process " + std::to_string(process.id()) + " " + process.describe_end();
      if (const std::string tail = process.log_tail(tail_lines); !tail.empty()) {
        text += "; the last lines of its log:\n" + tail;
      }
      return text;
    }
  }
  return "";
}

// Children whose end cannot be waited for are killed with their objects.
void Supervision::end_all(milliseconds grace) noexcept {
  const auto deadline = steady_clock::now() + grace;
  for (Child& one : children_) {
    if (!one.process) continue;
    try {
      const auto left = std::chrono::duration_cast<milliseconds>(deadline - steady_clock::now());
      static_cast<void>(one.process->wait(std::max(left, milliseconds(0))));
    } catch (...) {
    }
  }
  for (Child& one : children_) {
    if (!one.process) continue;
    loop_.remove(one.process->descriptor());
    try {
      one.process->terminate(milliseconds(200));
    } catch (...) {
    }
    one.process.reset();
  }
}

}  // namespace grainstep::orchestrator
