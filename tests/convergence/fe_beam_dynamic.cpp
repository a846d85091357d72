// The reference beam at a fifth of its size under the slug's mean pressure: deflection against the mesh, through the
// backend as a run drives it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../support/fe_scenes.hpp"
#include "fe-service/structure.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kHalfSpan = 0.1, kThickness = 0.01, kLoaded = 0.02, kDepth = 1e-3;

struct Load {
  double pressure;  ///< Pa, on |x1| < kLoaded, rising and falling as sin^2
  double duration;  ///< s
  double until;     ///< s
};

double value_of(const wire::Report& report, const std::string& name) {
  for (const wire::Observable& observable : report.observable()) {
    if (observable.name() == name) return observable.value();
  }
  ADD_FAILURE() << name << " is not reported";
  return 0.0;
}

/// The last report.
wire::Report run(scene::Layer::Material material, const Load& load, double refinement) {
  Structure structure;
  const wire::Ready ready = structure.prepare(test::setup_of(test::beam(material, kHalfSpan, kThickness, refinement)));
  const auto windows = static_cast<std::uint64_t>(std::ceil(load.until / ready.preferred_step()));
  const double window = load.until / static_cast<double>(windows);
  wire::Start start;
  start.set_window(window);
  start.set_windows(windows);
  start.set_impactor_steps(1);
  start.set_structure_steps(1);
  structure.start(start);
  const int nodes = ready.surface().position_size() / 2;
  const double width = ready.surface().position(2) - ready.surface().position(0);
  wire::Report report;
  wire::Kinematics next;
  for (std::uint64_t n = 0; n <= windows; ++n) {
    const double time = window * static_cast<double>(n);
    const double phase = time < load.duration ? std::sin(M_PI * time / load.duration) : 0.0;
    const double force = load.pressure * phase * phase * width * kDepth;
    wire::Forces forces;
    forces.set_window(n);
    for (int k = 0; k < nodes; ++k) {
      const double x = ready.surface().position(2 * k);
      const double share =
          ready.surface().position(2 * k + 1) < 0.0 ? 0.0 : std::clamp((kLoaded - x) / width + 0.5, 0.0, 1.0);
      forces.add_impulse(0.0);
      forces.add_impulse(-force * (k == 0 ? 0.5 : share) * window * (n == 0 ? 0.5 : 1.0));
    }
    structure.advance(forces, {.report = n == windows}, next);
    if (n == windows) structure.report(report);
    structure.complete();
  }
  return report;
}

struct Series {
  std::array<double, 4> deflection;  ///< m, 2, 4, 8, 16 quads through the thickness
  [[nodiscard]] double order() const {
    return std::log2((deflection[2] - deflection[1]) / (deflection[3] - deflection[2]));
  }
};

Series series(scene::Layer::Material material, const Load& load, const char* observable) {
  Series result{};
  for (std::size_t i = 0; i < 4; ++i) {
    result.deflection[i] = value_of(run(material, load, static_cast<double>(1 << i)), observable);
  }
  return result;
}

verification::Comparison order_of(const std::string& name, const Series& found) {
  verification::Comparison result;
  result.group = "convergence";
  result.name = name;
  result.quantity = "order in the mesh, 4, 8, 16 quads through the thickness (steps in proportion)";
  result.reference = "order of the elements and of central differences";
  result.origin = "constant-strain triangles: energies converge with h^2";
  result.found = found.order();
  return result;
}

TEST(FeBeamDynamic, ElasticDeflectionConverges) {
  const Series found = series(scene::Layer::MATERIAL_ELASTIC, {1e3, 0.15e-3, 0.12e-3}, "deflection");
  verification::Comparison order = order_of("Beam under a pulse of pressure, elastic", found);
  order.expected = 2.0;
  order.tolerance = 0.1;
  order.reason = "discretisation: asymptotic range";
  verification::check(order);
}

// 86 MPa for 0.15 ms is the slug at 400 m/s, scaled: w/L of 0.16.
TEST(FeBeamDynamic, PlasticPeakDeflectionConverges) {
  const Series found = series(scene::Layer::MATERIAL_DH36, {2.0 * 86.4e6, 0.15e-3, 0.6e-3}, "peak_deflection");
  const std::string name = "Beam under a pulse of pressure, DH36, w/L = 0.16";
  verification::Comparison order = order_of(name, found);
  order.expected = 1.5;
  order.tolerance = 0.25;
  order.reason = "discretisation: between 2 (bending) and 1 (hinges at the corners of the clamp, one element wide)";
  verification::check(order);
  verification::Comparison change = order_of(name, found);
  change.quantity = "change of the peak deflection from 8 to 16 quads / itself";
  change.found = found.deflection[3] / found.deflection[2] - 1.0;
  change.expected = 0.0;
  change.tolerance = 4e-3;
  change.reason = "discretisation: what a mesh of h/8 instead of h/4 is worth";
  verification::check(change);
  verification::curve({.group = "convergence",
                       .name = name,
                       .title = "peak deflection",
                       .x_label = "quads through the thickness",
                       .y_label = "peak deflection / half span",
                       .axes = verification::Curve::Axes::log_x,
                       .series = {{.label = "found",
                                   .x = {2.0, 4.0, 8.0, 16.0},
                                   .y = {found.deflection[0] / kHalfSpan, found.deflection[1] / kHalfSpan,
                                         found.deflection[2] / kHalfSpan, found.deflection[3] / kHalfSpan}}}});
}

}  // namespace
}  // namespace grainstep::fe
