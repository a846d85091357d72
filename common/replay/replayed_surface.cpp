#include "replay/replayed_surface.hpp"

#include <algorithm>
#include <cmath>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "base/number_text.hpp"
#include "participant/hello.hpp"
#include "replay/fitting.hpp"

namespace grainstep::replay {
namespace {

constexpr const char* key = "structure.replay.file";
constexpr double round_off = 1e-9;  // of a time

}  // namespace

wire::Hello ReplayedSurface::describe() const {
  wire::Hello hello = participant::hello(wire::STRUCTURE, "grainstep-replay (structure)", GRAINSTEP_VERSION, {2, 3});
  for (const char* capability : {"replay", "plane_strain", "axisymmetric", "state"}) hello.add_capabilities(capability);
  return hello;
}

wire::Ready ReplayedSurface::prepare(const wire::Setup& setup) {
  if (!setup.has_structure()) throw InputError("setup: started as a structure, but was sent an impactor's part");
  const scene::Structure& structure = setup.structure().structure();
  if (structure.type() != scene::Structure::TYPE_REPLAY) {
    throw InputError("structure.type: grainstep-replay plays `replay` and nothing else");
  }
  recording_.emplace(structure.replay().file(), key);
  const record::About& about = recording_->about();
  require_fits(setup, about, key);
  const wire::Surface& surface = about.structure().surface();
  account_ = load::SurfaceAccount(surface);
  position_.assign(surface.position().begin(), surface.position().end());
  return ready_of(about.structure(), setup, *recording_);
}

void ReplayedSurface::start(const wire::Start& start) {
  start_ = start;
  same_windows_ = same_windows(start, recording_->about());
  const double end = start.window() * static_cast<double>(start.windows());
  // Windows that do not divide the same time in the same way end half of one apart.
  if (end <= (recording_->end() + 0.5 * recording_->about().window()) * (1.0 + round_off)) return;
  throw InputError(std::string(key) + ": the record ends at " + rounded_text(recording_->end(), 6) +
                   " s, and this run is to end at " + rounded_text(end, 6) +
                   " s. End it earlier (time.end), or record a longer run");
}

std::vector<double> ReplayedSurface::position_at(double time) {
  const double rows = std::clamp(time / recording_->about().window(), 0.0, static_cast<double>(recording_->last()));
  const auto before = static_cast<std::uint64_t>(rows);
  const auto first = recording_->position(before);
  std::vector<double> out(first.begin(), first.end());
  if (before == recording_->last()) return out;
  const double part = rows - static_cast<double>(before);
  const auto second = recording_->position(before + 1);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += part * (second[i] - out[i]);
  return out;
}

void ReplayedSurface::move_to(std::uint64_t window, wire::Kinematics& next) {
  next.set_window(window);
  if (same_windows_) {
    const auto position = recording_->position(window);
    const auto velocity = recording_->velocity(window);
    next.mutable_position()->Assign(position.begin(), position.end());
    next.mutable_velocity()->Assign(velocity.begin(), velocity.end());
    position_.assign(position.begin(), position.end());
    return;
  }
  const std::vector<double> position = position_at(static_cast<double>(window) * start_.window());
  next.mutable_position()->Assign(position.begin(), position.end());
  next.clear_velocity();
  for (std::size_t i = 0; i < position.size(); ++i) next.add_velocity((position[i] - position_[i]) / start_.window());
  position_ = position;
}

void ReplayedSurface::advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) {
  const std::span impulse(forces.impulse().data(), static_cast<std::size_t>(forces.impulse_size()));
  account_.give(forces.window(), impulse, impulse);
  if (due.report) {
    due_report_.Clear();
    due_report_.mutable_energy()->set_interface_work(account_.work());
    for (const double received : account_.impulse()) {
      due_report_.mutable_momentum()->add_linear(0.0);
      due_report_.mutable_momentum()->add_interface_impulse(received);
      due_report_.mutable_momentum()->add_support_impulse(0.0);
    }
    due_report_.mutable_timing()->set_steps(forces.window() * start_.structure_steps());
  }
  if (due.snapshot) {
    due_snapshot_.Clear();
    due_snapshot_.mutable_position()->Assign(position_.begin(), position_.end());
    due_snapshot_.set_dimension(recording_->about().dimension());
  }
  window_ = forces.window() + 1;
  if (window_ > start_.windows()) return;  // nobody is shown what follows
  move_to(window_, next);
  account_.take(next);
}

void ReplayedSurface::report(wire::Report& report) { report.MergeFrom(due_report_); }

void ReplayedSurface::snapshot(wire::Snapshot& snapshot) { snapshot.MergeFrom(due_snapshot_); }

std::string ReplayedSurface::save() { return base::saved(*this); }

void ReplayedSurface::restore(std::string_view state) { base::restore(*this, state); }

}  // namespace grainstep::replay
