/// @file An observer that works in a thread of its own: who forwards messages must not wait for files.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "orchestrator/session/step_observer.hpp"

namespace grainstep::orchestrator {

/// Hands every call on to another observer, in the same order, from one thread. That observer belongs to this thread
/// from construction to finish(). Its exception ends the thread's work and is thrown by the next call here, so a limit
/// that a row exceeds stops the run a moment after the row, and nothing after that row is recorded.
/// Calls block while more than `most_bytes` wait: a slow disk slows the run, it does not eat the memory.
class BackgroundObserver final : public StepObserver {
 public:
  static constexpr std::size_t default_most_bytes = 256U << 20U;

  explicit BackgroundObserver(StepObserver& observer, std::size_t most_bytes = default_most_bytes);
  ~BackgroundObserver() override;

  void forces(const wire::Forces& forces) override;
  void kinematics(const wire::Kinematics& kinematics) override;
  [[nodiscard]] bool follows_surface() const override { return observer_.follows_surface(); }
  void report(wire::Role side, const wire::Report& report) override;
  void snapshot(wire::Role side, wire::Snapshot snapshot) override;
  void checkpoint(Checkpoint checkpoint) override;
  void idle() override;

  /// Waits until everything handed over is dealt with, the other's finish() included, and ends the thread. Throws the
  /// observer's exception unless a call has thrown it already. Calling it again does nothing.
  void finish() override;

 private:
  struct Report {
    wire::Role side;
    wire::Report message;
  };
  struct Snapshot {
    wire::Role side;
    wire::Snapshot message;
  };
  using Event = std::variant<wire::Forces, wire::Kinematics, Report, Snapshot, Checkpoint>;

  enum class Wake { now, later };
  void put(Event event, std::size_t bytes, Wake wake);
  void work();
  void deal_with(std::vector<Event>& events);
  void rethrow();

  StepObserver& observer_;
  std::size_t most_bytes_;

  std::mutex mutex_;  // guards what follows, up to the thread
  std::condition_variable filled_;
  std::condition_variable emptied_;
  std::vector<Event> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool awake_ = false;  // the thread has something worth waking for
  bool closing_ = false;
  std::exception_ptr failure_;
  std::atomic<bool> failed_ = false;

  std::thread thread_;
};

}  // namespace grainstep::orchestrator
