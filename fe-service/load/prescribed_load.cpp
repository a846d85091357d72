#include "fe-service/load/prescribed_load.hpp"

#include <algorithm>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "fe-service/solid.hpp"
#include "fe-service/windows.hpp"
#include "load/pressure_history.hpp"
#include "participant/hello.hpp"
#include "participant/resumed.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fe {

wire::Hello PrescribedLoad::describe() const {
  wire::Hello hello = participant::hello(wire::IMPACTOR, "grainstep-fe (prescribed load)", GRAINSTEP_VERSION, {2});
  for (const char* capability : {"pressure", "none", "plane_strain", "axisymmetric", "state"})
    hello.add_capabilities(capability);
  return hello;
}

wire::Ready PrescribedLoad::prepare(const wire::Setup& setup) {
  if (!setup.has_impactor()) throw InputError("setup: started as an impactor, but was sent a structure's part");
  const scene::Impactor& impactor = setup.impactor().impactor();
  const wire::Surface& surface = setup.impactor().surface();
  if (impactor.type() == scene::Impactor::TYPE_PRESSURE) {
    load::require_history(impactor.pressure());
    pressure_ = impactor.pressure();
    if (!setup.preview()) patch_.emplace(surface, impactor.pressure());
  } else if (impactor.type() != scene::Impactor::TYPE_NONE) {
    throw InputError(
        "impactor.type: grainstep-fe plays `foam`, `pressure` and `none`; a slug is computed by grainstep-dem");
  }
  measure_ = make_measure(setup.symmetry(), setup.depth());
  now_.assign(surface.position().begin(), surface.position().end());
  account_ = load::SurfaceAccount(surface);
  for (Doubles* nodal : {&before_, &between_, &impulse_, &last_step_}) *nodal = Doubles(now_.size(), 0.0);
  wire::Ready ready;
  ready.set_scene_hash(setup.scene_hash());
  ready.set_stable_step(participant::no_step_limit);
  ready.set_preferred_step(participant::no_step_limit);
  ready.set_counted("particles");
  ready.set_ledger(wire::FULL);
  participant::add_fact(ready, "particles", "0: a prescribed load, which has no step of its own");
  return ready;
}

double PrescribedLoad::step_impulse(std::uint64_t step) const {
  const double time = static_cast<double>(step);
  return load::impulse(*pressure_, std::max(0.0, time - 0.5) * step_, (time + 0.5) * step_);
}

/// The impulses of the steps that end in this window; that of the last one, which stands at t(n), also by itself.
void PrescribedLoad::evaluate(std::uint64_t window) {
  std::fill(impulse_.begin(), impulse_.end(), 0.0);
  std::fill(last_step_.begin(), last_step_.end(), 0.0);
  const std::uint32_t steps = window == 0 ? 1 : steps_;
  for (std::uint32_t k = 1; pressure_ && k < steps; ++k) {
    const double part = static_cast<double>(k) / steps;
    for (std::size_t i = 0; i < now_.size(); ++i) between_[i] = before_[i] + part * (now_[i] - before_[i]);
    patch_->press(step_impulse((window - 1) * steps_ + k), measure_, between_, impulse_);
  }
  if (pressure_) patch_->press(step_impulse(window * steps_), measure_, now_, last_step_);
  for (std::size_t i = 0; i < now_.size(); ++i) impulse_[i] += last_step_[i];
}

void PrescribedLoad::take(const wire::Kinematics& surface) {
  account_.take(surface);
  before_.swap(now_);
  now_.assign(surface.position().begin(), surface.position().end());
}

void PrescribedLoad::run(const wire::Start& start, participant::ImpactorLink& link) {
  steps_ = start.impactor_steps();
  step_ = start.window() / steps_;
  const auto resumed = participant::resumed(start, link);
  if (resumed) base::restore(*this, resumed->state);
  for (std::uint64_t window = resumed ? resumed->window + 1 : 0; window <= start.windows(); ++window) {
    if (window > 0) {
      const wire::Kinematics* surface = link.surface(window);
      if (surface == nullptr) return;
      take(*surface);
    }
    evaluate(window);
    hand_over(window, link);
    if (link.wants_state(window)) link.send_state(base::saved(*this));
  }
}

void PrescribedLoad::hand_over(std::uint64_t window, participant::ImpactorLink& link) {
  wire::Forces forces;
  forces.set_window(window);
  forces.mutable_impulse()->Assign(impulse_.begin(), impulse_.end());
  link.send(forces);
  account_.give(window, impulse_, last_step_);
  const participant::Due due = link.due(window);
  if (due.report) send_report(window, link);
  if (due.snapshot) {
    wire::Snapshot nothing_to_see;
    nothing_to_see.set_window(window);
    link.send(nothing_to_see);
  }
}

void PrescribedLoad::send_report(std::uint64_t window, participant::ImpactorLink& link) const {
  wire::Report report;
  report.set_window(window);
  report.mutable_energy()->set_interface_work(-account_.work());
  report.mutable_energy()->set_support_work(account_.work());
  for (const double given : account_.impulse()) {
    report.mutable_momentum()->add_linear(0.0);
    report.mutable_momentum()->add_interface_impulse(-given);
    report.mutable_momentum()->add_support_impulse(given);
  }
  if (pressure_) {
    const double time = static_cast<double>(window * steps_) * step_;
    add_observable(report, "prescribed_pressure", "Pa", load::pressure_at(*pressure_, time));
  }
  add_observable(report, "work_on_surface", "J", account_.work());
  report.mutable_timing()->set_steps(window * steps_);
  link.send(report);
}

}  // namespace grainstep::fe
