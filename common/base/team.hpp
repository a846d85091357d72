/// @file Threads that work on one thing together, many thousand times a second.
///
/// Whoever waits spins for a while first, for waking a thread takes longer than many a task; where there are fewer
/// cores than threads nobody spins. What a thread does may not depend on how many there are: share work by numbers that
/// follow from the work alone, and results are the same with any number.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace grainstep::base {

/// Cores that this process may use; a container or batch system may have granted fewer than the machine has.
[[nodiscard]] int usable_cores();

class Team {
 public:
  /// `threads`: the calling one included.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  Team(Team&&) = delete;
  Team& operator=(Team&&) = delete;

  [[nodiscard]] int size() const { return static_cast<int>(workers_.size()) + 1; }

  /// Calls work(part) for every part in [0, parts): each thread a run of neighbouring ones, always the same, and then
  /// what others have not come to. Returns when all is done; throws what one of them threw.
  template <typename Work>
  void each(std::int32_t parts, Work&& work) {
    if (workers_.empty() || parts < 2) {
      for (std::int32_t part = 0; part < parts; ++part) work(part);
      return;
    }
    using Plain = std::remove_reference_t<Work>;
    start({const_cast<void*>(static_cast<const void*>(&work)), parts,
           [](void* of, std::int32_t part) { (*static_cast<Plain*>(of))(part); }});
  }

 private:
  struct Job {
    void* work = nullptr;
    std::int32_t parts = 0;
    void (*call)(void* work, std::int32_t part) = nullptr;
  };
  /// Parts of one thread that nobody has begun with.
  struct alignas(64) Share {
    std::atomic<std::int32_t> next{0};
    std::int32_t end = 0;
  };
  void start(const Job& job);
  void serve(int number);
  void take_part(int number);
  void await(const std::atomic<std::uint32_t>& value, std::uint32_t old) const;

  std::vector<std::thread> workers_;
  std::vector<Share> shares_;
  bool may_spin_;
  Job job_;
  alignas(64) std::atomic<std::uint32_t> started_{0};   ///< jobs
  alignas(64) std::atomic<std::uint32_t> finished_{0};  ///< workers, of the last job
  std::atomic<bool> over_{false};
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace grainstep::base
