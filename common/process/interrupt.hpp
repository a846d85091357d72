/// @file Ctrl-C, SIGTERM and a closed terminal (SIGHUP) as something to poll() for, so that a run can be ended in good
/// order.
#pragma once

#include <signal.h>

namespace grainstep::process {

/// While it lives, the first SIGINT, SIGTERM or (unless it is ignored, as under nohup) SIGHUP makes descriptor()
/// readable instead of ending the process, and so does every SIGUSR1; once raised() has seen it, the next one ends the
/// process at once. Make it in the main thread before any other thread starts: threads inherit which signals are
/// blocked. One per process.
class Interrupt {
 public:
  Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  ~Interrupt();

  /// For poll(). Edge: stays readable until raised() is called.
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  /// Whether one of them has come since this object was made. Does not wait.
  [[nodiscard]] bool raised();

  /// Whether SIGUSR1 has come since this was asked last: something is wanted, but not the end.
  [[nodiscard]] bool asked();

 private:
  void look();

  int descriptor_ = -1;
  bool raised_ = false;
  bool asked_ = false;
  sigset_t before_{};
};

}  // namespace grainstep::process
