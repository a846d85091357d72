#include "orchestrator/supervision.hpp"

#include "base/error.hpp"
#include "orchestrator/peer.hpp"

namespace grainstep::orchestrator {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds last_words{500};
constexpr milliseconds end_of_a_lost_one{200};
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

void Supervision::watch(wire::Role role, bool finished) {
  Child& watched = child(role);
  if (finished || watched.told || !watched.ended || steady_clock::now() - *watched.ended < last_words) {
    return;
  }
  watched.told = true;
  throw PeerError(name_of(role), "its process ended before the run did");
}

void Supervision::watch(Finished finished) {
  watch(wire::IMPACTOR, finished.impactor);
  watch(wire::STRUCTURE, finished.structure);
}

std::string Supervision::account_of(const std::string& peer) {
  for (const Child& candidate : children_) {
    if (candidate.process && candidate.process->name() == peer) {
      process::ChildProcess& process = *candidate.process;
      static_cast<void>(process.wait(end_of_a_lost_one));
      std::string text = "process " + std::to_string(process.id()) + " " + process.describe_end();
      if (const std::string tail = process.log_tail(tail_lines); !tail.empty()) {
        text += "; the last lines of its log:\n" + tail;
      }
      return text;
    }
  }
  return "";
}

void Supervision::end_all(milliseconds grace) {
  const auto deadline = steady_clock::now() + grace;
  for (const Child& one : children_) {
    if (one.process) {
      const auto left = std::chrono::duration_cast<milliseconds>(deadline - steady_clock::now());
      static_cast<void>(one.process->wait(std::max(left, milliseconds(0))));
    }
  }
  for (Child& one : children_) {
    if (one.process) {
      loop_.remove(one.process->descriptor());
      one.process->terminate(milliseconds(200));
      one.process.reset();
    }
  }
}

}  // namespace grainstep::orchestrator
