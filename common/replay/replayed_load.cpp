#include "replay/replayed_load.hpp"

#include "base/archive.hpp"
#include "base/error.hpp"
#include "ledger/observables.hpp"
#include "participant/hello.hpp"
#include "participant/resumed.hpp"
#include "replay/fitting.hpp"

namespace grainstep::replay {
namespace {

constexpr const char* key = "impactor.replay.file";

void add_observable(wire::Report& report, std::string_view name, const char* unit, double value) {
  wire::Observable& one = *report.add_observable();
  one.set_name(std::string(name));
  one.set_unit(unit);
  one.set_value(value);
}

}  // namespace

wire::Hello ReplayedLoad::describe() const {
  wire::Hello hello = participant::hello(wire::IMPACTOR, "grainstep-replay (impactor)", GRAINSTEP_VERSION, {2, 3});
  for (const char* capability : {"replay", "plane_strain", "axisymmetric", "state"}) hello.add_capabilities(capability);
  return hello;
}

wire::Ready ReplayedLoad::prepare(const wire::Setup& setup) {
  if (!setup.has_impactor()) throw InputError("setup: started as an impactor, but was sent a structure's part");
  const scene::Impactor& impactor = setup.impactor().impactor();
  if (impactor.type() != scene::Impactor::TYPE_REPLAY) {
    throw InputError("impactor.type: grainstep-replay plays `replay` and nothing else");
  }
  recording_.emplace(impactor.replay().file(), key);
  const record::About& about = recording_->about();
  require_fits(setup, about, key);
  if (!setup.preview()) {
    const wire::Surface& surface = setup.impactor().surface();
    history_.emplace(*recording_, surface, key);
    account_ = load::SurfaceAccount(surface);
    impulse_.assign(static_cast<std::size_t>(surface.position_size()), 0.0);
  }
  wire::Ready ready = ready_of(about.impactor(), setup, *recording_);
  ready.set_ledger(wire::FULL);
  return ready;
}

void ReplayedLoad::run(const wire::Start& start, participant::ImpactorLink& link) {
  steps_ = start.impactor_steps();
  history_->agree(start.window(), start.window() * static_cast<double>(start.windows()));
  const auto resumed = participant::resumed(start, link);
  if (resumed) base::restore(*this, resumed->state);
  for (std::uint64_t window = resumed ? resumed->window + 1 : 0; window <= start.windows(); ++window) {
    if (window > 0) {
      const wire::Kinematics* surface = link.surface(window);
      if (surface == nullptr) return;
      account_.take(*surface);
    }
    hand_over(window, link);
    if (link.wants_state(window)) link.send_state(base::saved(*this));
  }
}

void ReplayedLoad::hand_over(std::uint64_t window, participant::ImpactorLink& link) {
  history_->impulse(window, impulse_);
  wire::Forces forces;
  forces.set_window(window);
  forces.mutable_impulse()->Assign(impulse_.begin(), impulse_.end());
  link.send(forces);
  account_.give(window, impulse_, impulse_);
  history_->add_retreat(window, account_.velocity(), retreat_);
  const participant::Due due = link.due(window);
  if (due.report) send_report(window, link);
  if (due.snapshot) {
    wire::Snapshot nothing_to_see;
    nothing_to_see.set_window(window);
    link.send(nothing_to_see);
  }
}

void ReplayedLoad::send_report(std::uint64_t window, participant::ImpactorLink& link) const {
  wire::Report report;
  report.set_window(window);
  report.mutable_energy()->set_interface_work(-account_.work());
  report.mutable_energy()->set_support_work(account_.work());
  report.mutable_energy()->set_kinetic(recording_->impactor_energy());
  for (std::size_t axis = 0; axis < account_.impulse().size(); ++axis) {
    report.mutable_momentum()->add_linear(recording_->impactor_momentum()[axis]);
    report.mutable_momentum()->add_interface_impulse(-account_.impulse()[axis]);
    report.mutable_momentum()->add_support_impulse(account_.impulse()[axis]);
  }
  add_observable(report, ledger::observable::work_on_surface, "J", account_.work());
  if (const double speed = recording_->about().impactor_speed(); speed > 0.0) {
    const double given = speed * retreat_.impulse;
    add_observable(report, ledger::observable::surface_speed_ratio, "", given > 0.0 ? retreat_.work / given : 0.0);
    add_observable(report, ledger::observable::surface_speed_departure, "",
                   given > 0.0 ? retreat_.departure / given : 0.0);
  }
  report.mutable_timing()->set_steps(window * steps_);
  link.send(report);
}

}  // namespace grainstep::replay
