/// @file Runs the real engine against a scripted surface, without transport or orchestrator.
#pragma once

#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "contact/moving_surface.hpp"
#include "dem-service/lammps/slug_engine.hpp"
#include "dem-service/mpi_start.hpp"
#include "dem-service/native/engine.hpp"
#include "dem-service/slug/layout.hpp"
#include "participant/schedule.hpp"

namespace grainstep::dem::rig {

using surface::Vec2;

/// The reference slug's particles, scaled to D = 1 mm so that a few of them make a slug; no mirror.
inline wire::Setup reference_setup() {
  wire::Setup setup;
  setup.set_protocol(wire::PROTOCOL_VERSION);
  setup.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  setup.set_depth(1e-3);
  scene::Impactor& impactor = *setup.mutable_impactor()->mutable_impactor();
  impactor.set_type(scene::Impactor::TYPE_SLUG);
  scene::Slug& slug = *impactor.mutable_slug();
  slug.set_half_width(0.02);
  slug.set_height(0.04);
  slug.set_relative_density(0.2);
  slug.set_speed(400.0);
  slug.set_seed(1);
  slug.set_slice_angle(0.1);  // of discs it is not read, but every key has its range
  scene::Particle& particle = *slug.mutable_particle();
  particle.set_diameter(1e-3);
  particle.set_density(2700.0);
  particle.set_normal_stiffness(7.3e6);
  particle.set_tangential_ratio(2.0 / 7.0);
  particle.set_restitution(0.7);
  particle.set_friction(0.7);
  slug.mutable_surface_contact()->set_lever_arm(scene::SurfaceContact::LEVER_ARM_CONTACT_POINT);
  return setup;
}

inline scene::Slug& slug_of(wire::Setup& setup) {
  return *setup.mutable_impactor()->mutable_impactor()->mutable_slug();
}

/// An open piece through these nodes, at rest.
inline void set_surface(wire::Setup& setup, const std::vector<Vec2>& nodes) {
  wire::Surface& surface = *setup.mutable_impactor()->mutable_surface();
  surface.Clear();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const double x : nodes[i].c) surface.add_position(x);
    for (int c = 0; c < 2; ++c) surface.add_velocity(0.0);
    if (i == 0) continue;
    surface.add_facet(static_cast<std::uint32_t>(i - 1));
    surface.add_facet(static_cast<std::uint32_t>(i));
  }
}

/// A flat surface at x2 = 0 from x1 = -length to length.
inline void set_flat_surface(wire::Setup& setup, double length, int segments) {
  std::vector<Vec2> nodes;
  for (int i = 0; i <= segments; ++i) nodes.push_back({{length * (2.0 * i / segments - 1.0), 0.0}});
  set_surface(setup, nodes);
}

/// Where node `node` is at the end of window n, given where it was at the start.
using Motion = std::function<Vec2(std::uint64_t window, const Vec2& start)>;

inline Motion at_rest() {
  return [](std::uint64_t, const Vec2& start) { return start; };
}

/// Plays the structure and keeps everything that the impactor says.
class ScriptedLink final : public participant::ImpactorLink {
 public:
  ScriptedLink(const wire::Setup& setup, const wire::Start& start, Motion motion)
      : initial_(setup.impactor().surface()), start_(start), motion_(std::move(motion)) {}

  const wire::Kinematics* surface(std::uint64_t window) override {
    if (window > stop_before) return nullptr;
    kinematics_.Clear();
    kinematics_.set_window(window);
    for (int i = 0; i < initial_.position_size(); i += 2) {
      const Vec2 start{{initial_.position(i), initial_.position(i + 1)}};
      const Vec2 now = motion_(window, start);
      const Vec2 mean = (now - motion_(window - 1, start)) * (1.0 / start_.window());
      for (int c = 0; c < 2; ++c) {
        kinematics_.add_position(now[static_cast<std::size_t>(c)]);
        kinematics_.add_velocity(mean[static_cast<std::size_t>(c)]);
      }
    }
    return &kinematics_;
  }
  participant::Due due(std::uint64_t window) const override { return participant::due_at(start_, window); }
  void send(const wire::Forces& sent) override { forces.push_back(sent); }
  void send(wire::Report& sent) override { reports.push_back(sent); }
  void send(const wire::Snapshot& sent) override { snapshots.push_back(sent); }
  bool wants_state(std::uint64_t window) override {
    asked_of_ = window;
    return save_at.contains(window);
  }
  void send_state(std::string_view state) override { states[asked_of_] = state; }
  std::optional<std::string_view> state() const override { return resume_from; }

  std::set<std::uint64_t> save_at;              ///< windows whose state is wanted
  std::map<std::uint64_t, std::string> states;  ///< of these windows
  std::optional<std::string> resume_from;
  std::uint64_t stop_before = ~std::uint64_t{0};  ///< the run is ended instead of a later window's surface
  std::vector<wire::Forces> forces;
  std::vector<wire::Report> reports;
  std::vector<wire::Snapshot> snapshots;

 private:
  wire::Surface initial_;
  wire::Start start_;
  Motion motion_;
  std::uint64_t asked_of_ = 0;
  wire::Kinematics kinematics_;
};

inline EngineOptions alone() {
  start_mpi();
  return {.communicator = MPI_COMM_SELF, .lammps_log = {}};
}

/// Windows of `steps` steps of dt each, `windows` of them; one report and snapshot at the start and at the end.
inline wire::Start start_of(double dt, std::uint64_t windows, std::uint32_t steps = 1) {
  wire::Start start;
  start.set_window(dt * steps);
  start.set_windows(windows);
  start.set_impactor_steps(steps);
  start.set_structure_steps(1);
  start.set_report_every(static_cast<double>(windows));
  start.set_snapshot_every(static_cast<double>(windows));
  return start;
}

/// CTest runs the tests of engines twice, once with each of them (cmake/GrainstepTargets.cmake).
inline bool native_is_tested() {
  const char* engine = std::getenv("GRAINSTEP_TEST_ENGINE");
  return engine != nullptr && std::string(engine) == "native";
}

inline ScriptedLink run(const wire::Setup& setup, const wire::Start& start,
                        const std::vector<PlacedParticle>& particles, const Motion& motion = at_rest()) {
  ScriptedLink link(setup, start, motion);
  if (native_is_tested()) {
    native::make_engine(slug_model_of(setup), setup.impactor(), particles)->run(start, link);
  } else {
    SlugEngine(alone(), setup, particles).run(start, &link);
  }
  return link;
}

/// The slug's own particles, where its seed puts them.
inline ScriptedLink run_slug(const wire::Setup& setup, const wire::Start& start, const Motion& motion = at_rest()) {
  const contact::MovingSurface surface(setup.impactor().surface());
  return run(setup, start, lay_out(slug_model_of(setup), surface.now()), motion);
}

inline SlugModel model_of(const wire::Setup& setup) {
  return make_slug_model(setup.impactor().impactor(), setup.symmetry(), setup.depth(), setup.mirror());
}

inline const wire::Field& field(const wire::Snapshot& snapshot, const std::string& name) {
  for (const wire::Field& candidate : snapshot.point_field()) {
    if (candidate.name() == name) return candidate;
  }
  throw std::runtime_error("no field " + name);
}

inline double observable(const wire::Report& report, const std::string& name) {
  for (const wire::Observable& candidate : report.observable()) {
    if (candidate.name() == name) return candidate.value();
  }
  throw std::runtime_error("no observable " + name);
}

}  // namespace grainstep::dem::rig
