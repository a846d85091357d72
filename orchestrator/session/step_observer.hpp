/// @file Who looks at what passes by in a run. The lock step forwards first and tells afterwards.
#pragma once

#include "grainstep/wire.pb.h"
#include "orchestrator/session/checkpoint.hpp"

namespace grainstep::orchestrator {

/// Calls come in the order of the messages; those of one side are ordered in time. Exceptions end the run:
/// NumericalError when a limit is exceeded, OutputError when nothing can be written any more.
class StepObserver {
 public:
  StepObserver() = default;
  StepObserver(const StepObserver&) = delete;
  StepObserver& operator=(const StepObserver&) = delete;
  virtual ~StepObserver() = default;

  virtual void forces(const wire::Forces& forces) = 0;
  /// The surface at the end of the window that the next Forces belong to. Only told to who follows_surface().
  virtual void kinematics(const wire::Kinematics& /*kinematics*/) {}
  [[nodiscard]] virtual bool follows_surface() const { return false; }
  virtual void report(wire::Role side, const wire::Report& report) = 0;
  virtual void snapshot(wire::Role side, wire::Snapshot snapshot) = 0;

  /// Both states of a window, of which and of all before it everything else has been told, and nothing of later ones.
  // NOLINTNEXTLINE(performance-unnecessary-value-param): who overrides it keeps it
  virtual void checkpoint(Checkpoint /*checkpoint*/) {}

  /// Now and then, when messages have been dealt with: time to show progress, to write.
  virtual void idle() = 0;

  /// The last message has passed by: returns when everything is dealt with and written.
  virtual void finish() = 0;
};

}  // namespace grainstep::orchestrator
