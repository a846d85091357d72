/// @file A structure that is moved window by window (participant/backend.hpp has the order of calls), whatever its
/// kind.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/team.hpp"
#include "participant/backend.hpp"

namespace grainstep::fe {

class WindowedStructure {
 public:
  virtual ~WindowedStructure() = default;
  virtual void fill_ready(wire::Ready& ready) const = 0;
  virtual void start(const wire::Start& start) = 0;
  virtual void advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) = 0;
  virtual void report(wire::Report& report) = 0;
  virtual void snapshot(wire::Snapshot& snapshot) = 0;
  virtual void complete() = 0;
  /// The state after complete(), and back in place of it (common/base/archive.hpp).
  [[nodiscard]] virtual std::string save() = 0;
  virtual void restore(std::string_view state) = 0;
};

/// A rigid target (rigid.hpp) or a deformable body (deformable.hpp), as the scene asks.
/// Throws InputError for what cannot be computed here.
/// `team`, which outlives it, computes it; without one, the calling thread does.
[[nodiscard]] std::unique_ptr<WindowedStructure> make_structure(const wire::Setup& setup, base::Team* team = nullptr);

/// Throws PeerError unless the message holds an impulse of two components for each of `nodes`, all finite.
void check_forces(const wire::Forces& forces, std::size_t nodes);

void add_observable(wire::Report& report, const char* name, const char* unit, double value);

}  // namespace grainstep::fe
