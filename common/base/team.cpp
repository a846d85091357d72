#include "base/team.hpp"

#include <sched.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace grainstep::base {
namespace {

// Some steps of a few thousand grains; a sleeper takes some 50 us to come back.
constexpr auto longest_spin = std::chrono::microseconds(100);
constexpr int looks_between_clocks = 64;

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

int usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

Team::Team(int threads)
    : shares_(static_cast<std::size_t>(std::max(threads, 1))), may_spin_(usable_cores() >= threads) {
  try {
    for (int number = 1; number < threads; ++number) workers_.emplace_back([this, number] { serve(number); });
  } catch (...) {  // no more threads to be had: those that there are do it
    may_spin_ = false;
  }
}

Team::~Team() {
  over_.store(true, std::memory_order_relaxed);
  started_.fetch_add(1, std::memory_order_release);
  started_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

/// Until `value` is another than `old`.
void Team::await(const std::atomic<std::uint32_t>& value, std::uint32_t old) const {
  if (may_spin_) {
    const auto end = std::chrono::steady_clock::now() + longest_spin;
    do {
      for (int look = 0; look < looks_between_clocks; ++look) {
        if (value.load(std::memory_order_acquire) != old) return;
        pause();
      }
    } while (std::chrono::steady_clock::now() < end);
  }
  value.wait(old, std::memory_order_acquire);
}

void Team::take_part(int number) {
  try {
    for (int n = 0; n < size(); ++n) {
      Share& share = shares_[static_cast<std::size_t>((number + n) % size())];
      while (true) {
        const std::int32_t part = share.next.fetch_add(1, std::memory_order_relaxed);
        if (part >= share.end) break;
        job_.call(job_.work, part);
      }
    }
  } catch (...) {
    const std::scoped_lock lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
}

void Team::start(const Job& job) {
  job_ = job;
  std::int32_t begin = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(size()); ++n) {
    Share& share = shares_[n];
    share.next.store(begin, std::memory_order_relaxed);
    share.end = begin = static_cast<std::int32_t>(std::int64_t{job.parts} * static_cast<std::int64_t>(n + 1) / size());
  }
  finished_.store(0, std::memory_order_relaxed);
  started_.fetch_add(1, std::memory_order_release);
  started_.notify_all();
  take_part(0);
  const auto all = static_cast<std::uint32_t>(workers_.size());
  for (std::uint32_t done = finished_.load(std::memory_order_acquire); done != all;
       done = finished_.load(std::memory_order_acquire)) {
    await(finished_, done);
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Team::serve(int number) {
  std::uint32_t seen = 0;
  while (true) {
    await(started_, seen);
    ++seen;
    if (over_.load(std::memory_order_relaxed)) return;
    take_part(number);
    finished_.fetch_add(1, std::memory_order_release);
    finished_.notify_one();
  }
}

}  // namespace grainstep::base
