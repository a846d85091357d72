/// @file What a C++ backend implements to take part in a run; serve.hpp does the talking.
///
/// Order of calls, structure:   describe, prepare, start, then for every window n = first..last:
///                              advance(n), report(n) and snapshot(n) where due, complete(n).
/// Order of calls, impactor:    describe, prepare, run (which itself asks its ImpactorLink for surfaces).
/// Exceptions: InputError when the scene asks for what this backend cannot do; NumericalError when the computation has
/// left its range of validity. Both are sent to the orchestrator as Error and end the run.
/// Threads: all calls come from one thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "grainstep/wire.pb.h"

namespace grainstep::participant {

/// Which extra output the window in progress wants.
struct Due {
  bool report = false;
  bool snapshot = false;
};

class StructureBackend {
 public:
  virtual ~StructureBackend() = default;

  [[nodiscard]] virtual wire::Hello describe() const = 0;

  /// Builds the model. The Ready holds the surface (topology and kinematics at t = 0).
  [[nodiscard]] virtual wire::Ready prepare(const wire::Setup& setup) = 0;

  virtual void start(const wire::Start& start) = 0;

  /// Receives the impulse of window n = forces.window() and moves the structure from t(n) to t(n+1), filling `next`
  /// (window n+1). Only what `next` needs is done here. Where `due` asks, the state at t(n) is kept for
  /// report/snapshot. After the last window it is called as well, for the state at the end; `next` is then not sent.
  virtual void advance(const wire::Forces& forces, Due due, wire::Kinematics& next) = 0;

  /// The state at t(n), velocities synchronised to t(n). Called after `next` was sent.
  virtual void report(wire::Report& report) = 0;
  virtual void snapshot(wire::Snapshot& snapshot) = 0;

  /// Everything the other side need not wait for: internal forces at t(n+1), stability, guards.
  virtual void complete() = 0;

  /// With the capability "state" only: all that decides what follows, after complete(n). A new backend that was given
  /// it by restore(), after prepare() and start(), goes on with advance(n+1), bit for bit. restore() throws
  /// std::range_error for bytes that are no state of this model.
  [[nodiscard]] virtual std::string save();
  virtual void restore(std::string_view state);
};

/// The conversation as an impactor sees it while it runs.
class ImpactorLink {
 public:
  virtual ~ImpactorLink() = default;

  /// Blocks until the surface at the end of window n is here. nullptr: the orchestrator ended the run; return from
  /// run(). The message stays valid until the next call.
  [[nodiscard]] virtual const wire::Kinematics* surface(std::uint64_t window) = 0;

  [[nodiscard]] virtual Due due(std::uint64_t window) const = 0;
  /// Forces will be sent within microseconds; may be left out. Where the other side sleeps, it wakes up for them.
  virtual void soon() {}
  virtual void send(const wire::Forces& forces) = 0;
  virtual void send(wire::Report& report) = 0;  ///< the link fills in Timing.wait
  virtual void send(const wire::Snapshot& snapshot) = 0;

  /// With the capability "state" only. Whether the state at t(n) is wanted, all of it is done for that: asked once,
  /// after report and snapshot of window n; then send_state() is next. A run that continues was given a state() and
  /// begins with window n+1, bit for bit.
  [[nodiscard]] virtual bool wants_state(std::uint64_t /*window*/) { return false; }
  virtual void send_state(std::string_view /*state*/) {}
  [[nodiscard]] virtual std::optional<std::string_view> state() const { return std::nullopt; }
};

class ImpactorBackend {
 public:
  virtual ~ImpactorBackend() = default;

  [[nodiscard]] virtual wire::Hello describe() const = 0;
  [[nodiscard]] virtual wire::Ready prepare(const wire::Setup& setup) = 0;

  /// Runs all windows: for n = first..last: evaluate contact at t(n), link.send(forces n) at once, report and snapshot
  /// where due (n), then on to window n+1 with link.surface(n+1).
  virtual void run(const wire::Start& start, ImpactorLink& link) = 0;
};

}  // namespace grainstep::participant
