#include "fe-service/rigid.hpp"

#include <cmath>

#include "base/error.hpp"
#include "fe-service/initial_velocity.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fe {
namespace {

double thickness_of(const scene::Structure& structure) {
  double sum = 0.0;
  for (const scene::Layer& layer : structure.layers()) sum += layer.thickness();
  return sum;
}

double areal_mass_of(const scene::Structure& structure) {
  double sum = 0.0;
  for (const scene::Layer& layer : structure.layers()) sum += layer.density() * layer.thickness();
  return sum;
}

}  // namespace

Rigid::Rigid(const scene::Structure& structure, const Measure& measure)
    : free_(structure.motion() == scene::Structure::MOTION_FREE) {
  if (structure.layers().empty())
    throw InputError("structure.layers: none given; a rigid target takes its depth from them");
  const double thickness = thickness_of(structure);
  const double half = structure.half_span();
  const bool full = structure.extent() == scene::Structure::EXTENT_FULL;
  if (full) {
    outline_ = {{-half, -thickness}, {-half, 0.0}, {half, 0.0}, {half, -thickness}};
  } else {
    outline_ = {{0.0, 0.0}, {half, 0.0}, {half, -thickness}};
  }
  if (!free_) return;
  mass_ = areal_mass_of(structure) * half * (full ? 2.0 : 1.0) * fe::thickness(measure, full ? 0.0 : 0.5 * half);
  velocity_ = mean_initial_velocity(structure, measure).y;
}

void Rigid::fill_nodes(Doubles& position, Doubles& velocity, double speed) const {
  for (const Vec2 node : outline_) {
    position.Add(node.x);
    position.Add(node.y + height_);
    velocity.Add(0.0);
    velocity.Add(speed);
  }
}

void Rigid::fill_ready(wire::Ready& ready) const {
  ready.set_stable_step(participant::no_step_limit);
  ready.set_preferred_step(participant::no_step_limit);
  ready.set_mass(mass_);
  if (free_) ready.set_free_mass(mass_);
  wire::Surface& surface = *ready.mutable_surface();
  surface.set_dimension(2);
  fill_nodes(*surface.mutable_position(), *surface.mutable_velocity(), velocity_);
  for (std::uint32_t k = 1; k < outline_.size(); ++k) {
    surface.add_facet(k - 1);
    surface.add_facet(k);
  }
}

void Rigid::start(const wire::Start& start) {
  window_length_ = start.window();
  steps_ = start.structure_steps();
}

void Rigid::advance(const wire::Forces& forces, participant::Due /*due*/, wire::Kinematics& next) {
  check_forces(forces, outline_.size());
  Vec2 share{0.0, 0.0};
  for (int i = 0; i + 1 < forces.impulse_size(); i += 2)
    share = share + Vec2{forces.impulse(i) / steps_, forces.impulse(i + 1) / steps_};
  at_ = state_before(share);
  const double height_before = height_;
  for (std::uint32_t k = 0; k < steps_; ++k) step(share, k);
  ++window_;
  next.Clear();
  next.set_window(window_);
  fill_nodes(*next.mutable_position(), *next.mutable_velocity(), (height_ - height_before) / window_length_);
}

/// The state at t(n), with half of the step to come; the first one has its half only.
Rigid::State Rigid::state_before(Vec2 share) const {
  const double part = window_ == 0 ? 0.0 : 0.5;
  const double gained = free_ ? part * share.y / mass_ : 0.0;  // m/s
  State at;
  at.deflection = -height_;
  at.peak = peak_;
  at.peak_time = peak_time_;
  at.kinetic = 0.5 * mass_ * velocity_ * (velocity_ + 2.0 * gained);
  at.momentum = mass_ * (velocity_ + gained);
  at.work = work_ + part * share.y * velocity_;
  at.received = received_ + part * share;
  return at;
}

void Rigid::step(Vec2 share, std::uint32_t k) {
  received_ = received_ + share;
  if (!free_) return;
  const double before = velocity_;
  velocity_ += share.y / mass_;
  work_ += 0.5 * share.y * (before + velocity_);
  height_ += velocity_ * window_length_ / steps_;
  if (std::abs(height_) <= std::abs(peak_)) return;
  peak_ = -height_;
  peak_time_ = window_length_ * (static_cast<double>(window_) + (k + 1.0) / steps_);
}

void Rigid::report(wire::Report& report) {
  report.Clear();
  report.set_window(window_ - 1);
  report.mutable_energy()->set_kinetic(at_.kinetic);
  report.mutable_energy()->set_interface_work(at_.work);
  wire::Momentum& momentum = *report.mutable_momentum();
  for (const double p : {0.0, at_.momentum}) momentum.add_linear(p);
  for (const double p : {at_.received.x, at_.received.y}) momentum.add_interface_impulse(p);
  for (const double p : {-at_.received.x, free_ ? 0.0 : -at_.received.y}) momentum.add_support_impulse(p);
  add_observable(report, "deflection", "m", at_.deflection);
  add_observable(report, "peak_deflection", "m", at_.peak);
  add_observable(report, "peak_deflection_time", "s", at_.peak_time);
  if (free_) add_observable(report, "velocity", "m/s", at_.momentum / mass_);
  report.mutable_timing()->set_steps(window_ * steps_);
}

void Rigid::snapshot(wire::Snapshot& snapshot) {
  snapshot.Clear();
  snapshot.set_window(window_ - 1);
  for (const Vec2 node : outline_) {
    snapshot.add_position(node.x);
    snapshot.add_position(node.y - at_.deflection);
  }
}

}  // namespace grainstep::fe
