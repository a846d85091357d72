/// @file A structure that moves as another run has recorded it, whatever hits it: `structure.type: replay`.
///
/// To the impactor of the record, in its windows, the same bits; so that impactor's results are those of the run. In
/// other windows the surface moves evenly between two recorded rows, as it does for an impactor of several steps per
/// window.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "load/surface_account.hpp"
#include "participant/backend.hpp"
#include "replay/recording.hpp"

namespace grainstep::replay {

class ReplayedSurface final : public participant::StructureBackend {
 public:
  [[nodiscard]] wire::Hello describe() const override;
  /// InputError for another type, a record that cannot be read, or one that does not fit.
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override;
  /// InputError for a run that is longer than the record.
  void start(const wire::Start& start) override;
  void advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) override;
  void report(wire::Report& report) override;
  void snapshot(wire::Snapshot& snapshot) override;
  void complete() override {}
  [[nodiscard]] std::string save() override;
  void restore(std::string_view state) override;

  /// What a window leaves for the next one.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("window", window_);
    archive.fixed("position", position_);
    archive("account", account_);
  }

 private:
  void move_to(std::uint64_t window, wire::Kinematics& next);
  [[nodiscard]] std::vector<double> position_at(double time);

  std::optional<Recording> recording_;
  wire::Start start_;
  bool same_windows_ = true;
  std::uint64_t window_ = 0;      ///< to which the surface has moved
  std::vector<double> position_;  ///< m, then
  load::SurfaceAccount account_;
  wire::Report due_report_;  ///< of the window that advance() was called for
  wire::Snapshot due_snapshot_;
};

}  // namespace grainstep::replay
