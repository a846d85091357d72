#include "spring.hpp"

#include <base/error.hpp>
#include <cmath>
#include <participant/hello.hpp>

namespace {

using grainstep::wire::Setup;

double setting(const Setup& setup, const char* name) {
  const auto& settings = setup.structure().structure().external().fields();
  const auto found = settings.find(name);
  if (found == settings.end() || !(found->second.number_value() > 0.0)) {
    throw grainstep::InputError(std::string("structure.external.") + name +
                                ": a spring needs a number above 0 (SI: kg, N/m, m); found " +
                                (found == settings.end() ? "nothing" : found->second.ShortDebugString()));
  }
  return found->second.number_value();
}

void observe(grainstep::wire::Report& report, const char* name, const char* unit, double value) {
  auto& observable = *report.add_observable();
  observable.set_name(name);
  observable.set_unit(unit);
  observable.set_value(value);
}

}  // namespace

grainstep::wire::Hello Spring::describe() const {
  auto hello = grainstep::participant::hello(grainstep::wire::STRUCTURE, "mass on a spring (C++ example)", "1", {2});
  for (const char* word : {"external", "plane_strain"}) hello.add_capabilities(word);
  return hello;
}

grainstep::wire::Ready Spring::prepare(const Setup& setup) {
  mass_ = setting(setup, "mass");
  stiffness_ = setting(setup, "stiffness");
  right_ = 0.5 * setting(setup, "width");
  left_ = setup.mirror() ? 0.0 : -right_;
  grainstep::wire::Ready ready;
  ready.set_scene_hash(setup.scene_hash());
  ready.set_stable_step(2.0 / std::sqrt(stiffness_ / mass_));  // of central differences: 2/omega
  ready.set_preferred_step(0.02 * ready.stable_step());
  ready.set_counted("elements");
  ready.set_size(1);
  ready.set_mass(mass_);
  ready.set_ledger(grainstep::wire::FULL);
  *ready.mutable_surface() = surface();
  grainstep::participant::add_fact(ready, "spring",
                                   std::to_string(mass_) + " kg on " + std::to_string(stiffness_) + " N/m");
  return ready;
}

grainstep::wire::Surface Spring::surface() const {
  grainstep::wire::Surface out;
  out.set_dimension(2);
  for (const double x : {left_, 0.0, right_, 0.0}) {
    out.add_position(x);
    out.add_velocity(0.0);
  }
  for (const unsigned node : {0U, 1U}) out.add_facet(node);
  return out;
}

void Spring::start(const grainstep::wire::Start& start) {
  steps_in_window_ = start.structure_steps();
  step_ = start.window() / steps_in_window_;
}

void Spring::advance(const grainstep::wire::Forces& forces, grainstep::participant::Due /*due*/,
                     grainstep::wire::Kinematics& next) {
  const double impulse[2] = {(forces.impulse(0) + forces.impulse(2)) / steps_in_window_,
                             (forces.impulse(1) + forces.impulse(3)) / steps_in_window_};
  const double from = state_.x;
  for (unsigned k = 0; k < steps_in_window_; ++k) {
    const bool first = steps_ == 0;
    const double spring = -stiffness_ * state_.x * step_ * (first ? 0.5 : 1.0);
    const double half = first ? 0.0 : 0.5;
    const double before = state_.v;
    if (k == 0) {
      at_ = state_;
      at_.v += half * (impulse[1] + spring) / mass_;
      at_.kinetic = 0.5 * mass_ * before * (2.0 * at_.v - before);
      at_.work += half * impulse[1] * before;
      for (int c = 0; c < 2; ++c) at_.received[c] += half * impulse[c];
      at_.held[0] -= half * impulse[0];
      at_.held[1] += half * spring;
    }
    state_.v += (impulse[1] + spring) / mass_;
    state_.work += 0.5 * impulse[1] * (before + state_.v);
    for (int c = 0; c < 2; ++c) state_.received[c] += impulse[c];
    state_.held[0] -= impulse[0];
    state_.held[1] += spring;
    state_.x += step_ * state_.v;
    ++steps_;
    if (std::abs(state_.x) > std::abs(peak_)) {
      peak_ = state_.x;
      peak_time_ = static_cast<double>(steps_) * step_;
    }
  }
  const double mean = (state_.x - from) / (step_ * steps_in_window_);
  for (const double x : {left_, right_}) {
    next.add_position(x);
    next.add_position(state_.x);
    next.add_velocity(0.0);
    next.add_velocity(mean);
  }
}

void Spring::report(grainstep::wire::Report& report) {
  auto& momentum = *report.mutable_momentum();
  for (const double p : {0.0, mass_ * at_.v}) momentum.add_linear(p);
  for (const double p : at_.received) momentum.add_interface_impulse(p);
  for (const double p : at_.held) momentum.add_support_impulse(p);
  auto& energy = *report.mutable_energy();
  energy.set_kinetic(at_.kinetic);
  energy.set_elastic(0.5 * stiffness_ * at_.x * at_.x);
  energy.set_interface_work(at_.work);
  observe(report, "deflection", "m", -at_.x);
  observe(report, "peak_deflection", "m", -peak_);
  observe(report, "peak_deflection_time", "s", peak_time_);
  report.mutable_timing()->set_steps(steps_);
}

void Spring::snapshot(grainstep::wire::Snapshot& snapshot) {
  for (const double x : {left_, at_.x, right_, at_.x, 0.5 * (left_ + right_), at_.x - 0.1 * (right_ - left_)})
    snapshot.add_position(x);
  for (const unsigned point : {0U, 1U, 2U}) snapshot.add_cell(point);
}
