/// @file Two participants in three dimensions, solved by hand: a free rigid plate of two triangles, and one sphere that
/// is thrown at it obliquely. Central differences on both sides, with as many steps as windows.
#pragma once

#include <array>
#include <cstdint>

#include "participant/backend.hpp"
#include "participant/hello.hpp"
#include "surface/vec.hpp"

namespace grainstep::orchestrator::fake {

using surface::Vec3;

inline void put(google::protobuf::RepeatedField<double>* out, const Vec3& value) {
  for (std::size_t c = 0; c < 3; ++c) out->Add(value[c]);
}

/// A square in the plane x2 = 0 with nodes at its corners and outward normals along +x2; it moves without turning.
class FreePlate final : public participant::StructureBackend {
 public:
  static constexpr double mass = 2.0;  // kg
  static constexpr double side = 1.0;  // m
  static constexpr std::array<std::array<unsigned, 3>, 2> triangles = {{{0, 2, 1}, {0, 3, 2}}};

  [[nodiscard]] static std::array<Vec3, 4> nodes(const Vec3& at) {
    return {at, at + Vec3{{side, 0.0, 0.0}}, at + Vec3{{side, 0.0, side}}, at + Vec3{{0.0, 0.0, side}}};
  }

  [[nodiscard]] wire::Hello describe() const override {
    wire::Hello out = participant::hello(wire::STRUCTURE, "plate", "1", {3});
    out.add_capabilities("external");
    return out;
  }
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    wire::Ready out;
    out.set_scene_hash(setup.scene_hash());
    out.set_stable_step(1e-3);
    out.set_preferred_step(2.5e-4);
    out.set_counted("elements");
    out.set_size(2);
    out.set_ledger(wire::FULL);
    out.set_mass(mass);
    out.set_free_mass(mass);
    wire::Surface& surface = *out.mutable_surface();
    surface.set_dimension(3);
    for (const Vec3& node : nodes({})) {
      put(surface.mutable_position(), node);
      put(surface.mutable_velocity(), {});
    }
    for (const auto& triangle : triangles) {
      for (const unsigned node : triangle) surface.add_facet(node);
    }
    return out;
  }
  void start(const wire::Start& start) override { step_ = start.window(); }
  void advance(const wire::Forces& forces, participant::Due /*due*/, wire::Kinematics& next) override {
    Vec3 impulse;
    for (int i = 0; i < forces.impulse_size(); ++i) impulse[static_cast<std::size_t>(i % 3)] += forces.impulse(i);
    const double half = forces.window() == 0 ? 0.0 : 0.5;
    now_ = v_ + impulse * (half / mass);
    received_now_ = received_ + impulse * half;
    at_ = x_;
    v_ += impulse * (1.0 / mass);
    received_ += impulse;
    x_ += v_ * step_;
    ++steps_;
    for (const Vec3& node : nodes(x_)) {
      put(next.mutable_position(), node);
      put(next.mutable_velocity(), v_);
    }
  }
  void report(wire::Report& report) override {
    put(report.mutable_momentum()->mutable_linear(), now_ * mass);
    put(report.mutable_momentum()->mutable_interface_impulse(), received_now_);
    put(report.mutable_momentum()->mutable_support_impulse(), {});
    report.mutable_energy()->set_kinetic(0.5 * mass * dot(now_, now_));
    report.mutable_energy()->set_interface_work(0.5 * mass * dot(now_, now_));
    report.mutable_timing()->set_steps(steps_);
  }
  void snapshot(wire::Snapshot& snapshot) override {
    snapshot.set_dimension(3);
    for (const Vec3& node : nodes(at_)) put(snapshot.mutable_position(), node);
    for (const auto& triangle : triangles) {
      for (const unsigned node : triangle) snapshot.add_cell(node);
    }
  }
  void complete() override {}

 private:
  double step_ = 0.0;
  Vec3 x_, v_, now_, at_, received_, received_now_;
  std::uint64_t steps_ = 0;
};

/// A smooth sphere of radius R; a penalty spring pushes it back where it overlaps the plate.
class ThrownSphere final : public participant::ImpactorBackend {
 public:
  static constexpr double mass = 0.5;       // kg
  static constexpr double radius = 0.05;    // m
  static constexpr double stiffness = 2e4;  // N/m
  static constexpr Vec3 velocity = {{1.0, -3.0, 0.5}};

  [[nodiscard]] wire::Hello describe() const override {
    wire::Hello out = participant::hello(wire::IMPACTOR, "sphere", "1", {3});
    out.add_capabilities("external");
    return out;
  }
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override {
    wire::Ready out;
    out.set_scene_hash(setup.scene_hash());
    out.set_stable_step(1e-3);
    out.set_preferred_step(2.5e-4);
    out.set_counted("particles");
    out.set_size(1);
    out.set_ledger(wire::FULL);
    out.set_mass(mass);
    out.set_largest_particle(2.0 * radius);
    return out;
  }
  void run(const wire::Start& start, participant::ImpactorLink& link) override {
    const double h = start.window();
    double height = 0.0;  // of the plate
    for (std::uint64_t n = 0; n <= start.windows(); ++n) {
      const double force = stiffness * std::max(0.0, radius - (x_[1] - height));
      const double impulse = force * h * (n == 0 ? 0.5 : 1.0);
      send_forces(n, impulse, link);
      const double half = n == 0 ? 0.0 : 0.5;
      extra(n, half * impulse, height, link);
      const wire::Kinematics* next = n == start.windows() ? nullptr : link.surface(n + 1);
      if (next == nullptr) return;
      v_[1] += impulse / mass;
      given_ += impulse;
      // Work on the plate: this impulse moves with the mean of the plate's velocities before and after it.
      work_ -= impulse * (n == 0 ? 0.5 * next->velocity(1) : 0.5 * (plate_velocity_ + next->velocity(1)));
      plate_velocity_ = next->velocity(1);
      height = next->position(1);
      corner_ = {{next->position(0), 0.0, next->position(2)}};
      x_ += v_ * h;
      ++steps_;
    }
  }

 private:
  // To the touched triangle's nodes, by its linear shape functions: of the square, both triangles have node 0.
  void send_forces(std::uint64_t window, double impulse, participant::ImpactorLink& link) const {
    const double a = (x_[0] - corner_[0]) / FreePlate::side;
    const double b = (x_[2] - corner_[2]) / FreePlate::side;
    std::array<double, 4> part = a > b ? std::array{1.0 - a, a - b, b, 0.0} : std::array{1.0 - b, 0.0, a, b - a};
    wire::Forces forces;
    forces.set_window(window);
    for (const double share : part) put(forces.mutable_impulse(), {{0.0, -share * impulse, 0.0}});
    link.send(forces);
  }

  void extra(std::uint64_t window, double half_impulse, double height, participant::ImpactorLink& link) const {
    const auto due = link.due(window);
    const double overlap = std::max(0.0, radius - (x_[1] - height));
    const Vec3 now = v_ + Vec3{{0.0, half_impulse / mass, 0.0}};
    if (due.report) {
      wire::Report report;
      report.set_window(window);
      put(report.mutable_momentum()->mutable_linear(), now * mass);
      put(report.mutable_momentum()->mutable_interface_impulse(), {{0.0, given_ + half_impulse, 0.0}});
      put(report.mutable_momentum()->mutable_support_impulse(), {});
      report.mutable_energy()->set_kinetic(0.5 * mass * dot(now, now));
      report.mutable_energy()->set_elastic(0.5 * stiffness * overlap * overlap);
      report.mutable_energy()->set_interface_work(report.energy().kinetic() + report.energy().elastic() -
                                                  0.5 * mass * dot(velocity, velocity));
      wire::Observable& work = *report.add_observable();
      work.set_name("work_on_surface");
      work.set_unit("J");
      work.set_value(work_ - half_impulse * plate_velocity_);
      report.mutable_timing()->set_steps(steps_);
      link.send(report);
    }
    if (due.snapshot) {
      wire::Snapshot snapshot;
      snapshot.set_window(window);
      snapshot.set_dimension(3);
      put(snapshot.mutable_position(), x_);
      wire::Field& radii = *snapshot.add_point_field();
      radii.set_name("radius");
      radii.set_unit("m");
      radii.set_components(1);
      radii.add_value(radius);
      link.send(snapshot);
    }
  }

  Vec3 x_ = {{0.3, 0.06, 0.2}};
  Vec3 v_ = velocity;
  Vec3 corner_;
  double plate_velocity_ = 0.0;
  double given_ = 0.0;
  double work_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace grainstep::orchestrator::fake
