/// @file Turns what passes by into results: the only writer of a run, and the one who looks after its limits.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ledger/guards.hpp"
#include "ledger/ledger.hpp"
#include "ledger/load_history.hpp"
#include "orchestrator/record/free_oscillation.hpp"
#include "orchestrator/record/row.hpp"
#include "orchestrator/record/surface_record.hpp"
#include "orchestrator/session/step_observer.hpp"
#include "orchestrator/session/step_plan.hpp"
#include "results/results_file.hpp"
#include "results/snapshots.hpp"
#include "scene/groups.hpp"
#include "transport/channel.hpp"

namespace grainstep::orchestrator {

/// What a summary needs to know of a run, whole or not.
struct Findings {
  double final_time = 0.0;                           ///< s, of the last row
  double energy_drift = 0.0;                         ///< largest of the rows, over the last row's reference
  double momentum_error = 0.0;                       ///< largest of the rows
  double transmitted = 0.0;                          ///< Pa s, at the last row
  std::optional<double> early_impulse;               ///< Pa s, between t_hat 0.05 and 0.3
  double peak_deflection = 0.0;                      ///< m, with its sign
  double peak_deflection_time = 0.0;                 ///< s
  std::optional<Oscillation> rest;                   ///< what the structure swings about once the load is over
  std::optional<double> peak_core_compression;       ///< of the core's thickness; nothing without a core
  std::optional<double> peak_core_compression_time;  ///< s
  std::optional<double> surface_speed_ratio;         ///< of a recorded load
  std::optional<double> surface_speed_departure;     ///< the same
  std::uint64_t windows = 0;                         ///< seen
  std::uint64_t impactor_steps = 0;
  std::uint64_t structure_steps = 0;
};

class Recorder final : public StepObserver {
 public:
  struct Context {
    const scene::Scene& scene;
    const scene::Groups& groups;
    const StepPlan& plan;
    const wire::Surface& surface;
    ledger::Masses masses = {};
    ledger::Levels levels = {};
    /// Given a checkpoint and this recorder's own state at it, with everything before it in the file. Empty: none is
    /// kept.
    std::function<void(Checkpoint, std::string)> keep = {};
    SurfaceRecord* record = nullptr;  ///< outlives the recorder; nullptr: nobody wants one
  };
  /// `tick` is called when the run has a moment, with the windows seen so far. References must outlive the recorder.
  Recorder(const Context& context, const results::RunDirectory& directory, results::ResultsFile& file,
           std::function<void(std::uint64_t)> tick);

  void forces(const wire::Forces& forces) override;
  void kinematics(const wire::Kinematics& kinematics) override;
  [[nodiscard]] bool follows_surface() const override { return record_ != nullptr; }
  void report(wire::Role side, const wire::Report& report) override;
  void snapshot(wire::Role side, wire::Snapshot snapshot) override;
  void checkpoint(Checkpoint checkpoint) override;
  void idle() override;

  void finish() override;

  /// Goes on from the state that `keep` was given. std::range_error as base::Loading.
  void restore(std::string_view state);

  /// So far.
  [[nodiscard]] Findings findings() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("snapshots", snapshots_);
    archive("load", load_);
    archive("sums", sums_);
    archive("first reports", first_);
    if constexpr (Archive::loads) {
      if (first_) make_ledger();
    }
    if (ledger_) archive("ledger", *ledger_);
    serialize_pending(archive);
    archive("time of the last row", row_time_);
    archive("transmitted then", row_transmitted_);
    archive("window of the last profile", profile_window_);
    archive("impulse then", profile_mark_);
    archive("unexplained", unexplained_);
    archive("deflections", deflections_);
    archive("findings", findings_);
  }

 private:
  /// What a row waits for.
  struct Pending {
    ledger::HandedOver handed_over;
    double transmitted = 0.0;
    std::optional<wire::Report> impactor;
    std::optional<wire::Report> structure;

    template <class Archive>
    void serialize(Archive& archive) {
      archive("handed over", handed_over);
      archive("transmitted", transmitted);
      archive("impactor", impactor);
      archive("structure", structure);
    }
  };
  /// What the ledger counts from.
  struct FirstReports {
    wire::Report impactor, structure;

    template <class Archive>
    void serialize(Archive& archive) {
      archive("impactor", impactor);
      archive("structure", structure);
    }
  };
  template <class Archive>
  void serialize_pending(Archive& archive) {
    std::vector<std::uint64_t> windows;
    for (const auto& [window, row] : pending_) windows.push_back(window);
    archive("rows that wait", windows);
    for (const std::uint64_t window : windows) archive("row", pending_[window]);
  }
  void make_ledger();
  [[nodiscard]] double time_of(std::uint64_t window) const { return static_cast<double>(window) * plan_.window; }
  void complete_rows();
  void write_row(std::uint64_t window, const Pending& row);
  void judge(std::uint64_t window, const Pending& row, const ledger::Balance& balance) const;
  void remember(std::uint64_t window, const Pending& row, const ledger::Balance& balance);
  void describe_profiles();
  void write_profile(std::uint64_t window);

  const scene::Scene& scene_;
  const scene::Groups& groups_;
  StepPlan plan_;
  wire::Start start_;
  results::ResultsFile& file_;
  results::Snapshots snapshots_;
  ledger::Masses masses_;
  ledger::Levels levels_;
  std::function<void(std::uint64_t)> tick_;
  std::function<void(Checkpoint, std::string)> keep_;
  SurfaceRecord* record_;
  ledger::LoadHistory load_;
  ledger::ImpulseSums sums_;
  std::optional<FirstReports> first_;
  std::optional<ledger::Ledger> ledger_;  // made of them
  std::map<std::uint64_t, Pending> pending_;
  double row_time_ = 0.0;         // of the last row
  double row_transmitted_ = 0.0;  // at the last row
  std::uint64_t profile_window_ = 0;
  std::vector<double> profile_mark_;  // nodal impulse received up to the last profile
  transport::Clock::time_point flushed_;
  double unexplained_ = 0.0;  // J, largest of the rows
  std::vector<DeflectionSample> deflections_;
  Findings findings_;
};

}  // namespace grainstep::orchestrator
