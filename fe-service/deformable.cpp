#include "fe-service/deformable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "fe-service/initial_velocity.hpp"
#include "fe-service/layers.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fe {

namespace {

Body make_body(const scene::Structure& structure, const Measure& measure) {
  Body body(make_mesh(structure), make_layers(structure), measure);
  body.resist_volume(bulk_factors(structure));
  return body;
}

}  // namespace

Deformable::Deformable(const scene::Structure& structure, const scene::Guards& guards, const Measure& measure,
                       base::Team* team)
    : guards_(guards),
      body_(make_body(structure, measure)),
      undeformed_step_(body_.stable_step()),
      stable_step_(undeformed_step_) {
  if (team != nullptr) body_.share_among(*team);
  set_initial_velocity(structure, body_);
  for (const Corner c : body_.mesh().surface()) surface_.push_back(body_.mesh().corner(c));
  travelled_.resize(surface_.size());
}

void Deformable::fill_ready(wire::Ready& ready) const {
  ready.set_stable_step(stable_step_);
  ready.set_preferred_step(kStepSafety * stable_step_);
  ready.set_size(body_.mesh().triangles());
  ready.set_mass(body_.mass());
  ready.set_contact_mass(body_.corners.mass[body_.mesh().corner(body_.mesh().middle_of_face())]);
  ready.set_memory(body_.memory_bytes());
  wire::Surface& surface = *ready.mutable_surface();
  surface.set_dimension(2);
  for (std::size_t k = 0; k < surface_.size(); ++k) {
    surface.add_position(body_.corners.x[surface_[k]]);
    surface.add_position(body_.corners.y[surface_[k]]);
    surface.add_velocity(body_.corners.u[surface_[k]]);
    surface.add_velocity(body_.corners.v[surface_[k]]);
    if (k == 0) continue;
    surface.add_facet(static_cast<std::uint32_t>(k - 1));
    surface.add_facet(static_cast<std::uint32_t>(k));
  }
}

void Deformable::start(const wire::Start& start) {
  start_ = start;
  if (!(start.window() > 0.0) || start.structure_steps() == 0) {
    throw InputError(
        fmt::format("start: needs a window above 0 s and at least 1 structure step in it, found {:g} s and {}",
                    start.window(), start.structure_steps()));
  }
  window_length_ = start.window();
  substeps_ = start.structure_steps();
  substeps_fixed_ = start.structure_fixed();
  adapt();
}

void Deformable::advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) {
  check_forces(forces, surface_.size());
  const bool wanted = due.report || due.snapshot;
  const Velocities before = wanted ? Velocities::of(body_) : Velocities{};
  std::fill(travelled_.begin(), travelled_.end(), Vec2{0.0, 0.0});
  for (std::uint32_t k = 0; k < substeps_; ++k) {
    const Received gained = kick(forces, 0.5 * (step_before_ + step()));
    if (k == 0 && wanted) keep(due, before, step_before_ / (step_before_ + step()), gained);
    received_.interface = received_.interface + gained.interface;
    received_.supports = received_.supports + gained.supports;
    received_.work += gained.work;
    body_.drift(step());
    step_before_ = step();
    track_peaks(k);
    for (std::size_t i = 0; i < surface_.size(); ++i) {
      travelled_[i] = travelled_[i] + Vec2{body_.corners.u[surface_[i]], body_.corners.v[surface_[i]]};
    }
    if (k + 1 < substeps_) internal_forces();
  }
  fill_kinematics(next);
}

/// Velocities over one step. Returns what the surface and the supports gave.
Deformable::Received Deformable::kick(const wire::Forces& forces, double internal_weight) {
  const double share = 1.0 / substeps_;
  Received gained;
  const auto work = [&](std::size_t k) {
    const double* impulse = forces.impulse().data() + 2 * k;
    const std::size_t i = surface_[k];
    return share * (impulse[0] * body_.corners.u[i] + impulse[1] * body_.corners.v[i]);
  };
  double work_after = 0.0;
  for (std::size_t k = 0; k < surface_.size(); ++k) {
    gained.work_before += work(k);
    const std::size_t i = surface_[k];
    const Vec2 impulse =
        share * Vec2{forces.impulse(static_cast<int>(2 * k)), forces.impulse(static_cast<int>(2 * k + 1))};
    body_.corners.u[i] += impulse.x * body_.corners.inverse_mass[i];
    body_.corners.v[i] += impulse.y * body_.corners.inverse_mass[i];
    gained.interface = gained.interface + impulse;
  }
  body_.kick(internal_weight);
  gained.supports = body_.hold_supports();
  if (is_of_revolution(body_.measure())) gained.supports.x += internal_weight * body_.radial_force();
  for (std::size_t k = 0; k < surface_.size(); ++k) work_after += work(k);
  gained.work = 0.5 * (gained.work_before + work_after);
  return gained;
}

/// The output of t(n), while positions and stresses are still those of t(n).
void Deformable::keep(participant::Due due, const Velocities& before, double weight, const Received& gained) {
  const Velocities at = Velocities::blend(before, Velocities::of(body_), weight);
  if (due.snapshot) {
    snapshot_.Clear();
    snapshot_.set_window(window_);
    fe::fill_snapshot(body_, at, snapshot_);
  }
  if (!due.report) return;
  Received until = received_;
  until.interface = until.interface + weight * gained.interface;
  until.supports = until.supports + weight * gained.supports;
  // Over the whole step the impulse j does the work j . (V(n-1/2) + V(n+1/2))/2. Up to t(n) the surface has moved with
  // V(n-1/2) only: w j . V(n-1/2), which is what the impactor, with the same steps, has counted as well, and what the
  // conserved kinetic energy has gained from it.
  until.work += weight * gained.work_before;
  fill_report(before, at, until);
}

void Deformable::fill_report(const Velocities& before, const Velocities& at, const Received& until) {
  report_.Clear();
  report_.set_window(window_);
  const auto [elastic, plastic] = element_sums_ ? *element_sums_ : sum_elements();
  wire::Energy& energy = *report_.mutable_energy();
  energy.set_kinetic(conserved_kinetic_energy(body_, before, at));
  energy.set_elastic(elastic);
  energy.set_plastic(plastic_work_);
  energy.set_viscous(viscous_work_);
  energy.set_interface_work(until.work);
  wire::Momentum& momentum = *report_.mutable_momentum();
  const Vec2 linear = linear_momentum(body_, at);
  for (const double p : {linear.x, linear.y}) momentum.add_linear(p);
  for (const double p : {until.interface.x, until.interface.y}) momentum.add_interface_impulse(p);
  for (const double p : {until.supports.x, until.supports.y}) momentum.add_support_impulse(p);
  const double back = back_deflection(body_);
  const double front = front_deflection(body_);
  add_observable(report_, "deflection", "m", back);
  add_observable(report_, "deflection_front", "m", front);
  add_observable(report_, "peak_deflection", "m", peak_deflection_);
  add_observable(report_, "peak_deflection_time", "s", peak_deflection_time_);
  if (const auto compression = core_compression(body_)) {
    add_observable(report_, "core_compression", "", *compression);
    add_observable(report_, "peak_core_compression", "", peak_compression_);
    add_observable(report_, "peak_core_compression_time", "s", peak_compression_time_);
  }
  add_observable(report_, "min_element_quality", "", min_quality_);
  add_observable(report_, "stable_step", "s", stable_step_);
  add_observable(report_, "max_surface_speed", "m/s", max_surface_speed(body_, at));
  add_observable(report_, "max_plastic_strain", "", plastic.max_strain);
  add_observable(report_, "plastic_elements", "", static_cast<double>(plastic.elements));
  report_.mutable_timing()->set_steps(steps_);
}

void Deformable::report(wire::Report& report) { report.Swap(&report_); }
void Deformable::snapshot(wire::Snapshot& snapshot) { snapshot.Swap(&snapshot_); }

void Deformable::internal_forces() {
  const SweepResult result = body_.sweep(step());
  ++steps_;
  plastic_work_ += result.plastic_work;
  viscous_work_ += result.viscous_work;
  min_quality_ = result.min_quality;
  if (result.unconverged > 0) material_failed(body_, progress());
  if (!(min_quality_ >= guards_.element_quality())) check_quality(body_, guards_.element_quality(), progress());
}

void Deformable::track_peaks(std::uint32_t substep) {
  const double time = window_length_ * (static_cast<double>(window_) + (substep + 1.0) / substeps_);
  // Largest in size, with its sign: suction pulls the other way.
  const auto track = [time](double now, double& peak, double& peak_time) {
    if (std::abs(now) <= std::abs(peak)) return;
    peak = now;
    peak_time = time;
  };
  track(back_deflection(body_), peak_deflection_, peak_deflection_time_);
  if (const auto now = core_compression(body_)) track(*now, peak_compression_, peak_compression_time_);
}

void Deformable::fill_kinematics(wire::Kinematics& next) const {
  const int size = static_cast<int>(2 * surface_.size());
  next.set_window(window_ + 1);
  next.mutable_position()->Resize(size, 0.0);
  next.mutable_velocity()->Resize(size, 0.0);
  double* position = next.mutable_position()->mutable_data();
  double* velocity = next.mutable_velocity()->mutable_data();
  double sum = 0.0;
  for (std::size_t k = 0; k < surface_.size(); ++k) {
    position[2 * k] = body_.corners.x[surface_[k]];
    position[2 * k + 1] = body_.corners.y[surface_[k]];
    velocity[2 * k] = travelled_[k].x / substeps_;
    velocity[2 * k + 1] = travelled_[k].y / substeps_;
    sum += position[2 * k] + position[2 * k + 1];
  }
  if (!std::isfinite(sum)) check_finite(body_, progress());
}

// Nobody waits here: the kinematics are on their way. What a report of t(n) needs of the elements is summed here, too;
// in advance() the other side would wait for it.
void Deformable::complete() {
  ++window_;
  internal_forces();
  element_sums_.reset();
  if (participant::due_at(start_, window_).report) element_sums_ = sum_elements();
  if (window_ % kCheckInterval != 0) return;
  check_finite(body_, progress());
  stable_step_ = body_.stable_step();
  if (!(stable_step_ >= guards_.element_quality() * undeformed_step_)) {
    check_slivers(body_, undeformed_step_, guards_.element_quality(), progress());
  }
  adapt();
  last_good_time_ = progress().time;
}

void Deformable::adapt() {
  if (substeps_fixed_) {
    if (step() > stable_step_) check_fixed_step(body_, step(), progress());
    return;
  }
  substeps_ = std::max(substeps_, steps_needed(window_length_, kStepLimit * stable_step_, progress()));
}

Progress Deformable::progress() const {
  return {steps_, window_length_ * static_cast<double>(window_), last_good_time_};
}

}  // namespace grainstep::fe
