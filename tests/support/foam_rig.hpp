/// @file A foam projectile as the orchestrator drives it, on a flat face along x1 that moves as told.
#pragma once

#include <functional>
#include <vector>

#include "fe-service/foam/foam_impactor.hpp"
#include "participant/schedule.hpp"

namespace grainstep::fe::test {

/// The reference slug's block, with the defaults of the scene's keys.
inline scene::Impactor reference_foam() {
  scene::Impactor impactor;
  impactor.set_type(scene::Impactor::TYPE_FOAM);
  scene::Slug& slug = *impactor.mutable_slug();
  slug.set_half_width(0.1);
  slug.set_height(0.3);
  slug.set_relative_density(0.2);
  slug.set_speed(400.0);
  slug.mutable_particle()->set_density(2700.0);
  slug.mutable_particle()->set_normal_stiffness(7.3e6);
  slug.mutable_particle()->set_tangential_ratio(2.0 / 7.0);
  scene::Foam& foam = *impactor.mutable_foam();
  foam.set_elements(100);
  foam.set_strength(0.01);
  foam.set_shock_width(0.03);
  foam.set_poisson(0.25);
  foam.set_contact_stiffness(1.0);
  return impactor;
}

/// The reference plate's slug, a cylinder of spheres: in a solid of revolution.
inline scene::Impactor reference_cylinder() {
  scene::Impactor impactor = reference_foam();
  scene::Slug& slug = *impactor.mutable_slug();
  slug.set_height(0.15);
  slug.set_speed(320.8);
  slug.mutable_particle()->set_diameter(200e-6);
  impactor.mutable_foam()->clear_densest();
  return impactor;
}

class FoamRig final : public participant::ImpactorLink {
 public:
  /// Height (m) of the face, and its speed along x1 (m/s), at a time (s).
  struct Motion {
    std::function<double(double)> height = [](double) { return 0.0; };
    double sliding = 0.0;
    double finer = 1.0;                                       ///< steps are shorter by that
    scene::Symmetry symmetry = scene::SYMMETRY_PLANE_STRAIN;  ///< of revolution: the face is a disc, mirror is not read
  };

  double element_quality = 0.01;  ///< the guard's limit

  FoamRig() = default;
  explicit FoamRig(Motion motion) : motion_(std::move(motion)) {}

  /// Until `end` (s), with `steps` of the block's preferred ones in a window, or of parts of them.
  void run(const scene::Impactor& impactor, double end, std::uint32_t steps = 1, bool mirror = true) {
    wire::Setup setup;
    setup.set_symmetry(motion_.symmetry);
    setup.set_depth(1e-3);
    setup.set_scene_hash(7);
    setup.set_mirror(mirror && !ring());
    *setup.mutable_impactor()->mutable_impactor() = impactor;
    setup.mutable_impactor()->mutable_guards()->set_element_quality(element_quality);
    wire::Surface& surface = *setup.mutable_impactor()->mutable_surface();
    for (const double x : places()) {
      for (const double value : {x, motion_.height(0.0)}) surface.add_position(value);
      for (int c = 0; c < 2; ++c) surface.add_velocity(0.0);
    }
    surface.set_dimension(2);
    for (const std::uint32_t node : {0U, 1U, 1U, 2U}) surface.add_facet(node);
    FoamImpactor foam;
    ready = foam.prepare(setup);
    window = steps * ready.preferred_step() / motion_.finer;
    start_.set_window(window);
    start_.set_windows(static_cast<std::uint64_t>(end / window));
    start_.set_impactor_steps(steps);
    start_.set_structure_steps(1);
    start_.set_report_every(report_every);
    start_.set_snapshot_every(0);
    foam.run(start_, *this);
  }

  const wire::Kinematics* surface(std::uint64_t n) override {
    kinematics_.Clear();
    kinematics_.set_window(n);
    const double now = window * static_cast<double>(n);
    const double rise = motion_.height(now) - motion_.height(now - window);
    for (const double x : places()) {
      for (const double value : {x + motion_.sliding * now, motion_.height(now)}) kinematics_.add_position(value);
      for (const double value : {motion_.sliding, rise / window}) kinematics_.add_velocity(value);
    }
    return &kinematics_;
  }
  participant::Due due(std::uint64_t n) const override { return participant::due_at(start_, n); }
  void send(const wire::Forces& message) override {
    double sum[2] = {0.0, 0.0};
    for (int i = 0; i < message.impulse_size(); ++i) sum[i % 2] += message.impulse(i);
    along.push_back(sum[0]);
    pressed.push_back(-sum[1]);
  }
  void send(wire::Report& message) override { reports.push_back(message); }
  void send(const wire::Snapshot& /*message*/) override {}

  [[nodiscard]] double observed(const wire::Report& report, const std::string& name) const {
    for (const wire::Observable& one : report.observable()) {
      if (one.name() == name) return one.value();
    }
    return std::nan("");
  }

  double report_every = 100;
  double window = 0.0;  ///< s
  wire::Ready ready;
  std::vector<double> pressed, along;  ///< N s on the face in every window, against x2 and along x1
  std::vector<wire::Report> reports;

 private:
  [[nodiscard]] bool ring() const { return motion_.symmetry == scene::SYMMETRY_AXISYMMETRIC; }
  [[nodiscard]] std::vector<double> places() const { return {ring() ? 0.0 : -1.0, 0.1, 1.0}; }

  Motion motion_;
  wire::Start start_;
  wire::Kinematics kinematics_;
};

}  // namespace grainstep::fe::test
