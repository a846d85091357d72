#include "orchestrator/record/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "ledger/observables.hpp"
#include "orchestrator/record/progress.hpp"
#include "participant/schedule.hpp"

namespace grainstep::orchestrator {
namespace {

constexpr auto burst_interval = std::chrono::seconds(1);
constexpr std::size_t burst_bytes = 64U << 20U;
constexpr double early_from = 0.05;                                   // t_hat
constexpr double early_to = 0.3;                                      // t_hat
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();  // of an observable that a structure does not have

std::span<const double> span_of(const google::protobuf::RepeatedField<double>& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

ledger::SurfaceLoad surface_load(const Recorder::Context& context) {
  return context.scene.symmetry() == scene::SYMMETRY_AXISYMMETRIC
             ? ledger::SurfaceLoad::of_revolution(context.surface)
             : ledger::SurfaceLoad(context.surface, context.scene.depth());
}

/// A run that goes on has described them already.
bool has_profiles(const results::Contents& contents) {
  return contents.contains("/profiles/x1") || contents.contains("/profiles/position");
}

}  // namespace

Recorder::Recorder(const Context& context, const results::RunDirectory& directory, results::ResultsFile& file,
                   std::function<void(std::uint64_t)> tick)
    : scene_(context.scene),
      groups_(context.groups),
      plan_(context.plan),
      start_(context.plan.start()),
      file_(file),
      snapshots_(directory, file),
      masses_(context.masses),
      levels_(context.levels),
      tick_(std::move(tick)),
      keep_(context.keep),
      record_(context.record),
      load_(surface_load(context), {.window = context.plan.window, .steps = context.plan.impactor_steps},
            context.groups.loaded_area),
      sums_(load_.surface().dimension()),
      flushed_(transport::Clock::now()) {
  load_.watch(groups_.arrival + early_from * groups_.slug_time);
  load_.watch(groups_.arrival + early_to * groups_.slug_time);
  profile_mark_.assign(load_.surface().values(), 0.0);
  if (!has_profiles(file_.contents())) describe_profiles();
}

void Recorder::make_ledger() {
  ledger_.emplace(first_->impactor, first_->structure, plan_.impactor_steps == 1, masses_, levels_);
}

void Recorder::checkpoint(Checkpoint checkpoint) {
  if (record_ != nullptr) record_->flush();
  file_.flush();
  flushed_ = transport::Clock::now();
  if (keep_) keep_(std::move(checkpoint), base::saved(*this));
}

void Recorder::restore(std::string_view state) { base::restore(*this, state); }

// Of triangles the middle's place and the area, where segments have x1 and length.
void Recorder::describe_profiles() {
  const ledger::SurfaceLoad& surface = load_.surface();
  if (surface.dimension() == 3) {
    file_.add(results::Array{.dataset = "/profiles/position",
                             .meaning = {"m", "undeformed middle of every triangle"},
                             .columns = 3,
                             .values = surface.middles(),
                             .indices = {}});
    file_.add(results::Array{.dataset = "/profiles/area",
                             .meaning = {"m2", "undeformed area of every triangle"},
                             .values = surface.areas(),
                             .indices = {}});
    return;
  }
  file_.add(results::Array{.dataset = "/profiles/x1",
                           .meaning = {"m", "undeformed x1 of every segment's middle"},
                           .values = surface.midpoints(),
                           .indices = {}});
  file_.add(results::Array{.dataset = "/profiles/length",
                           .meaning = {"m", "undeformed length of every segment"},
                           .values = surface.lengths(),
                           .indices = {}});
}

void Recorder::kinematics(const wire::Kinematics& kinematics) { record_->kinematics(kinematics); }

void Recorder::forces(const wire::Forces& forces) {
  if (record_ != nullptr) record_->forces(forces);
  const auto impulse = span_of(forces.impulse());
  const std::uint64_t window = forces.window();
  sums_.add(impulse);
  load_.add(window, impulse);
  findings_.windows = window;
  if (participant::due_at(start_, window).report) {
    Pending& row = pending_[window];
    row.handed_over = sums_.handed_over();
    row.transmitted = load_.transmitted();
  }
  if (window != 0 && participant::falls_due(plan_.profile_every, window, plan_.windows)) write_profile(window);
}

// (4.3), averaged over the interval since the last profile.
void Recorder::write_profile(std::uint64_t window) {
  const std::vector<double> received = load_.received();
  std::vector<double> gained(received.size());
  std::transform(received.begin(), received.end(), profile_mark_.begin(), gained.begin(), std::minus<>());
  results::Line line{.dataset = "/profiles/pressure",
                     .meaning = {"Pa", "contact pressure on every segment, averaged over the interval (4.3)"},
                     .values = load_.surface().impulse_per_area(gained)};
  const double from = time_of(profile_window_);
  const double to = time_of(window);
  for (double& value : line.values) {
    value /= to - from;
  }
  file_.add(line);
  file_.add({{.dataset = "/profiles/from", .meaning = {"s", "start of the interval"}, .value = from},
             {.dataset = "/profiles/to", .meaning = {"s", "end of the interval"}, .value = to}});
  profile_mark_ = received;
  profile_window_ = window;
}

void Recorder::report(wire::Role side, const wire::Report& report) {
  if (record_ != nullptr && side == wire::IMPACTOR && report.window() == 0) record_->first_report(report);
  Pending& row = pending_[report.window()];
  (side == wire::IMPACTOR ? row.impactor : row.structure) = report;
  complete_rows();
}

void Recorder::complete_rows() {
  while (!pending_.empty()) {
    const auto& [window, row] = *pending_.begin();
    if (!row.impactor || !row.structure) {
      return;
    }
    write_row(window, row);
    pending_.erase(pending_.begin());
  }
}

void Recorder::write_row(std::uint64_t window, const Pending& row) {
  if (!ledger_) {
    first_ = {*row.impactor, *row.structure};
    make_ledger();
  }
  const ledger::Balance balance = ledger_->close(*row.impactor, *row.structure, row.handed_over);
  const double time = time_of(window);
  const double elapsed = time - row_time_;
  const RowData data{.time = time,
                     .mean_pressure = elapsed > 0.0 ? (row.transmitted - row_transmitted_) / elapsed : 0.0,
                     .transmitted = row.transmitted,
                     .impactor = *row.impactor,
                     .structure = *row.structure,
                     .balance = balance,
                     .dimension = static_cast<unsigned>(load_.surface().dimension())};
  file_.add(series_row(data, groups_));
  file_.add(ledger_row(data));
  file_.add(timing_row(data));
  row_time_ = time;
  row_transmitted_ = row.transmitted;
  remember(window, row, balance);
  judge(window, row, balance);
}

void Recorder::remember(std::uint64_t window, const Pending& row, const ledger::Balance& balance) {
  findings_.final_time = time_of(window);
  findings_.transmitted = row.transmitted;
  unexplained_ = std::max(unexplained_, balance.energy_drift * balance.energy_reference);
  findings_.energy_drift =
      balance.energy_reference > 0.0 ? unexplained_ / balance.energy_reference : balance.energy_drift;
  findings_.momentum_error = std::max(findings_.momentum_error, balance.momentum_error);
  findings_.peak_deflection = ledger::find(*row.structure, ledger::observable::peak_deflection).value_or(nothing);
  findings_.peak_deflection_time =
      ledger::find(*row.structure, ledger::observable::peak_deflection_time).value_or(nothing);
  if (const auto deflection = ledger::find(*row.structure, ledger::observable::deflection)) {
    deflections_.push_back({.time = time_of(window), .deflection = *deflection, .load = row.handed_over.sizes});
  }
  findings_.peak_core_compression = ledger::find(*row.structure, ledger::observable::peak_core_compression);
  findings_.peak_core_compression_time = ledger::find(*row.structure, ledger::observable::peak_core_compression_time);
  findings_.surface_speed_ratio = ledger::find(*row.impactor, ledger::observable::surface_speed_ratio);
  findings_.surface_speed_departure = ledger::find(*row.impactor, ledger::observable::surface_speed_departure);
  findings_.impactor_steps = row.impactor->timing().steps();
  findings_.structure_steps = row.structure->timing().steps();
  const double early = load_.watched()[1] - load_.watched()[0];
  if (std::isfinite(early)) {
    findings_.early_impulse = early;
  }
}

void Recorder::judge(std::uint64_t window, const Pending& row, const ledger::Balance& balance) const {
  const auto found = ledger::violation(
      scene_.guards(), {.balance = balance,
                        .overlap = ledger::find(*row.impactor, ledger::observable::overlap),
                        .element_quality = ledger::find(*row.structure, ledger::observable::element_quality),
                        .impactor = scene_.impactor().type()});
  if (found) {
    throw NumericalError("at window " + std::to_string(window) + " of " + std::to_string(plan_.windows) + " (" +
                         moment_text(time_of(window), groups_.reference_time) + "): " + *found);
  }
}

Findings Recorder::findings() const {
  Findings out = findings_;
  out.rest = last_free_oscillation(deflections_);
  return out;
}

void Recorder::snapshot(wire::Role side, wire::Snapshot snapshot) {
  snapshots_.add(side, time_of(snapshot.window()), snapshot);
}

void Recorder::idle() {
  const auto now = transport::Clock::now();
  if (now - flushed_ >= burst_interval || file_.pending_bytes() > burst_bytes) {
    file_.flush();
    flushed_ = transport::Clock::now();
  }
  if (record_ != nullptr) record_->flush_if_due();
  if (tick_) {
    tick_(findings_.windows);
  }
}

void Recorder::finish() {
  file_.flush();
  if (record_ != nullptr) record_->flush();
}

}  // namespace grainstep::orchestrator
