/// @file Two participants that are solved by hand: a mass on a spring with a flat surface, and one ball on a penalty
/// spring. Central differences on both sides, as the real ones.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "participant/backend.hpp"

namespace grainstep::orchestrator::fake {

inline constexpr double width = 1.0;    // m, of the surface
inline constexpr double depth = 0.001;  // m

inline void add_x2(google::protobuf::RepeatedField<double>* out, double value) {
  out->Add(0.0);
  out->Add(value);
}

/// What goes wrong, and in which window.
struct Trouble {
  std::uint64_t window = std::numeric_limits<std::uint64_t>::max();
  std::function<void()> act = [] {};
  std::function<void()> report = [] {};  // an impactor's, between its Forces and its Report
  void look(std::uint64_t now) const {
    if (now == window) {
      act();
    }
  }
  void look_at_report(std::uint64_t now) const {
    if (now == window) {
      report();
    }
  }
};

/// Mass m on a spring k, one segment of two nodes that move with it.
class SpringStructure final : public participant::StructureBackend {
 public:
  explicit SpringStructure(Trouble trouble = {}) : trouble_(std::move(trouble)) {}

  [[nodiscard]] wire::Hello describe() const override {
    wire::Hello out;
    out.set_backend("spring");
    out.set_role(wire::STRUCTURE);
    out.set_protocol(wire::PROTOCOL_VERSION);
    out.add_dimension(2);
    for (const char* word : {"external", "plane_strain"}) out.add_capabilities(word);
    return out;
  }
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    wire::Ready out;
    out.set_scene_hash(setup.scene_hash());
    out.set_stable_step(1e-3);
    out.set_preferred_step(1e-3);
    out.set_size(1);
    out.set_counted("elements");
    out.set_ledger(wire::FULL);
    out.set_mass(mass);
    out.mutable_surface()->set_dimension(2);
    for (const double x : {0.0, 0.0, width, 0.0}) {
      out.mutable_surface()->add_position(x);
      out.mutable_surface()->add_velocity(0.0);
    }
    out.mutable_surface()->add_facet(0);
    out.mutable_surface()->add_facet(1);
    return out;
  }
  void start(const wire::Start& start) override {
    substeps_ = start.structure_steps();
    step_ = start.window() / substeps_;
  }
  void advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) override {
    trouble_.look(forces.window());
    const double impulse = (forces.impulse(1) + forces.impulse(3)) / substeps_;
    if (due.report || due.snapshot) {
      keep(forces.window(), impulse);
    }
    const double from = x_;
    for (unsigned i = 0; i < substeps_; ++i) {
      const double half = forces.window() == 0 && i == 0 ? 0.5 : 1.0;
      const double spring = -stiffness * x_ * step_ * half;
      v_ += (impulse + spring) / mass;
      received_ += impulse;
      support_ += spring;
      x_ += v_ * step_;
      ++steps_;
    }
    next.set_window(forces.window() + 1);
    const double mean = (x_ - from) / (step_ * substeps_);
    for (const double x1 : {0.0, width}) {
      next.add_position(x1);
      next.add_position(x_);
      next.add_velocity(0.0);
      next.add_velocity(mean);
    }
  }
  void report(wire::Report& report) override { report.MergeFrom(kept_); }
  void snapshot(wire::Snapshot& snapshot) override {
    for (const double x : {0.0, kept_x_, width, kept_x_, 0.0, kept_x_ - 1.0}) snapshot.add_position(x);
    for (const unsigned node : {0U, 1U, 2U}) snapshot.add_cell(node);
  }
  void complete() override {}

  static constexpr double mass = 2.0;
  static constexpr double stiffness = 5e3;

 private:
  // Synchronised to t(n): half of the first substep's impulses counts before, half after.
  void keep(std::uint64_t window, double impulse) {
    const double half = window == 0 ? 0.0 : 0.5;
    const double spring = -stiffness * x_ * step_ * half;
    const double v = v_ + (half * impulse + spring) / mass;
    kept_ = {};
    kept_x_ = x_;
    add_x2(kept_.mutable_momentum()->mutable_linear(), mass * v);
    add_x2(kept_.mutable_momentum()->mutable_interface_impulse(), received_ + half * impulse);
    add_x2(kept_.mutable_momentum()->mutable_support_impulse(), support_ + spring);
    kept_.mutable_energy()->set_kinetic(0.5 * mass * v * v);
    kept_.mutable_energy()->set_elastic(0.5 * stiffness * x_ * x_);
    kept_.mutable_timing()->set_steps(steps_);
    auto* deflection = kept_.add_observable();
    deflection->set_name("deflection");
    deflection->set_unit("m");
    deflection->set_value(-x_);
  }

  Trouble trouble_;
  double step_ = 0.0;
  unsigned substeps_ = 1;
  double x_ = 0.0;
  double v_ = 0.0;
  double received_ = 0.0;
  double support_ = 0.0;
  std::uint64_t steps_ = 0;
  double kept_x_ = 0.0;
  wire::Report kept_;
};

/// One ball of mass m that falls on the surface with speed v0 and is pushed back by a penalty spring.
class BallImpactor final : public participant::ImpactorBackend {
 public:
  explicit BallImpactor(Trouble trouble = {}, double step = 2.5e-4) : trouble_(std::move(trouble)), preferred_(step) {}

  [[nodiscard]] wire::Hello describe() const override {
    wire::Hello out;
    out.set_backend("ball");
    out.set_role(wire::IMPACTOR);
    out.set_protocol(wire::PROTOCOL_VERSION);
    out.add_dimension(2);
    for (const char* word : {"external", "plane_strain"}) out.add_capabilities(word);
    return out;
  }
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    wire::Ready out;
    out.set_scene_hash(setup.scene_hash());
    out.set_stable_step(2e-3);
    out.set_preferred_step(preferred_);
    out.set_size(1);
    out.set_counted("particles");
    out.set_ledger(wire::FULL);
    return out;
  }
  void run(const wire::Start& start, participant::ImpactorLink& link) override {
    const double h = start.window() / start.impactor_steps();
    double surface = 0.0;
    double pending = force_at(surface) * h * 0.5;
    double impulse = pending;
    for (std::uint64_t n = 0; n <= start.windows(); ++n) {
      trouble_.look(n);
      wire::Forces forces;
      forces.set_window(n);
      for (int node = 0; node < 2; ++node) {
        forces.add_impulse(0.0);
        forces.add_impulse(-0.5 * impulse);
      }
      link.send(forces);
      extra(n, h, surface, link);
      if (n == start.windows()) {
        return;
      }
      const wire::Kinematics* next = link.surface(n + 1);
      if (next == nullptr) {
        return;
      }
      impulse = 0.0;
      for (unsigned i = 0; i < start.impactor_steps(); ++i) {
        v_ += pending / mass;
        given_ += pending;
        x_ += v_ * h;
        surface += next->velocity(1) * h;
        pending = force_at(surface) * h;
        impulse += pending;
        ++steps_;
      }
      surface = next->position(1);
    }
  }

  static constexpr double mass = 0.5;
  static constexpr double stiffness = 2e4;
  static constexpr double speed = 3.0;

 private:
  [[nodiscard]] double force_at(double surface) const { return x_ < surface ? stiffness * (surface - x_) : 0.0; }

  void extra(std::uint64_t window, double h, double surface, participant::ImpactorLink& link) {
    const auto due = link.due(window);
    if (due.report) trouble_.look_at_report(window);
    const double half = window == 0 ? 0.0 : 0.5 * h * force_at(surface);
    if (due.report) {
      wire::Report report;
      report.set_window(window);
      const double v = v_ + half / mass;
      add_x2(report.mutable_momentum()->mutable_linear(), mass * v);
      add_x2(report.mutable_momentum()->mutable_interface_impulse(), given_ + half);
      add_x2(report.mutable_momentum()->mutable_support_impulse(), 0.0);
      const double overlap = x_ < surface ? surface - x_ : 0.0;
      report.mutable_energy()->set_kinetic(0.5 * mass * v * v);
      report.mutable_energy()->set_elastic(0.5 * stiffness * overlap * overlap);
      report.mutable_timing()->set_steps(steps_);
      link.send(report);
    }
    if (due.snapshot) {
      wire::Snapshot snapshot;
      snapshot.set_window(window);
      snapshot.add_position(0.5 * width);
      snapshot.add_position(x_);
      link.send(snapshot);
    }
  }

  Trouble trouble_;
  double preferred_;
  double x_ = 0.01;
  double v_ = -speed;
  double given_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace grainstep::orchestrator::fake
