/// @file A small record, made by hand: three nodes of a face from x1 = 0 to 2, a load that comes and goes.
#pragma once

#include <cmath>
#include <filesystem>
#include <vector>

#include "base/temporary_directory.hpp"
#include "orchestrator/record/surface_record.hpp"

namespace grainstep::replay::test {

inline constexpr double window = 0.01;  // s
inline constexpr std::uint64_t windows = 40;
inline constexpr double speed = 5.0;  // m/s, of the impactor
inline constexpr std::size_t values = 6;

/// Nodes at `x1`, on x2 = 0; outward is +x2.
inline wire::Surface face(const std::vector<double>& x1) {
  wire::Surface surface;
  surface.set_dimension(2);
  for (std::size_t i = 0; i < x1.size(); ++i) {
    for (const double x : {x1[i], 0.0}) surface.add_position(x);
    for (int axis = 0; axis < 2; ++axis) surface.add_velocity(0.0);
    if (i > 0) {
      surface.add_facet(static_cast<std::uint32_t>(i) - 1);
      surface.add_facet(static_cast<std::uint32_t>(i));
    }
  }
  return surface;
}

inline record::About about() {
  record::About out;
  out.set_title("made by hand");
  out.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  out.set_depth(0.5);
  out.set_dimension(2);
  out.set_window(window);
  out.set_impactor_speed(speed);
  out.mutable_impactor()->set_stable_step(window / 3.0);
  out.mutable_impactor()->set_preferred_step(window / 7.0);
  out.mutable_impactor()->set_counted("particles");
  out.mutable_structure()->set_stable_step(0.1);
  out.mutable_structure()->set_preferred_step(0.1);
  *out.mutable_structure()->mutable_surface() = face({0.0, 1.0, 2.0});
  return out;
}

/// N s at node k along `axis` in window n; nothing from the 30th on.
inline double impulse(std::uint64_t n, std::size_t k, std::size_t axis) {
  if (n >= 30) return 0.0;
  const double x = static_cast<double>(n) + 0.3 * static_cast<double>(k);
  return axis == 0 ? 0.1 * std::sin(x) : -1.0 - std::cos(0.7 * x);
}

/// m/s, of all nodes along x2 in the window that ends at n.
inline double velocity(std::uint64_t n) { return n == 0 ? 0.0 : -0.2 - 0.01 * static_cast<double>(n); }

inline wire::Forces forces(std::uint64_t n) {
  wire::Forces out;
  out.set_window(n);
  for (std::size_t i = 0; i < values; ++i) out.add_impulse(impulse(n, i / 2, i % 2));
  return out;
}

inline wire::Kinematics kinematics(std::uint64_t n) {
  double height = 0.0;
  for (std::uint64_t k = 1; k <= n; ++k) height += window * velocity(k);
  wire::Kinematics out;
  out.set_window(n);
  for (std::size_t i = 0; i < values; ++i) {
    const std::size_t node = i / 2;
    out.add_position(i % 2 == 0 ? static_cast<double>(node) : height);
    out.add_velocity(i % 2 == 0 ? 0.0 : velocity(n));
  }
  return out;
}

inline void add(orchestrator::SurfaceRecord& record, std::uint64_t first, std::uint64_t last) {
  for (std::uint64_t n = first; n <= last; ++n) {
    if (n > 0) record.kinematics(kinematics(n));
    record.forces(forces(n));
    wire::Report report;
    report.mutable_energy()->set_kinetic(3.0);
    report.mutable_energy()->set_elastic(0.5);
    for (const double linear : {0.0, -1.25}) report.mutable_momentum()->add_linear(linear);
    if (n == 0) record.first_report(report);
    if (n % 7 == 0) record.flush();
  }
}

/// surface.h5 in a directory of its own.
class Recorded {
 public:
  explicit Recorded(std::uint64_t last = windows) {
    orchestrator::SurfaceRecord record(file(), about());
    add(record, 0, last);
    record.flush();
  }
  [[nodiscard]] std::filesystem::path directory() const { return directory_.path(); }
  [[nodiscard]] std::filesystem::path file() const { return directory() / "surface.h5"; }

 private:
  TemporaryDirectory directory_;
};

}  // namespace grainstep::replay::test
