// A clamped beam under uniform pressure, brought to rest: its deflection converges with the mesh to that of a
// Timoshenko beam with the plane-strain modulus.
#include <gtest/gtest.h>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

constexpr double kHalfSpan = 0.2;
constexpr double kModulus = 200e9 / (1.0 - 0.3 * 0.3);
constexpr double kPressure = 1e3;  ///< Pa: deflections of 1e-8 of the span, so that nothing is of finite strain
constexpr double kDepth = 1e-3;

/// q l^4/(384 E' I) + q l^2/(8 k G A), l = 2 L (Timoshenko and Gere, Mechanics of Materials).
double timoshenko(double thickness) {
  const double load = kPressure;  // on a unit depth
  const double span = 2.0 * kHalfSpan;
  const double bending = kModulus * std::pow(thickness, 3) / 12.0;
  const double shear = 5.0 / 6.0 * 200e9 / 2.6 * thickness;
  return load * std::pow(span, 4) / (384.0 * bending) + load * span * span / (8.0 * shear);
}

/// Impulse of the pressure over a step to the loaded face.
void press(Body& body, double step) {
  const Mesh& mesh = body.mesh();
  for (int column = 0; column <= mesh.columns; ++column) {
    const std::size_t i = mesh.corner({0, column});
    const double share = column == 0 || column == mesh.columns ? 0.5 : 1.0;
    body.corners.v[i] -= share * kPressure * mesh.width * kDepth * step * body.corners.inverse_mass[i];
  }
}

/// Damped motion near critical damping of the first mode.
double deflection(double thickness, int quads_through_thickness) {
  Body body =
      test::body_of(test::beam(scene::Layer::MATERIAL_ELASTIC, kHalfSpan, thickness, 0.5 * quads_through_thickness));
  const double omega = 22.37 / std::pow(2.0 * kHalfSpan, 2) * std::sqrt(kModulus / 8000.0 / 12.0) * thickness;
  test::Stepper stepper(body, 0.9 * body.stable_step());
  const double keep = (1.0 - omega * stepper.step()) / (1.0 + omega * stepper.step());
  double settled = 0.0;
  for (double until = 0.0; until < 100.0; until += 1.0) {
    while (stepper.time() * omega < until) {
      stepper([&](Body& b) {
        test::for_each_node(b, [keep](Nodes& nodes, std::size_t i) {
          nodes.u[i] *= keep;
          nodes.v[i] *= keep;
        });
        press(b, stepper.step());
        (void)b.hold_supports();
      });
    }
    const double now = back_deflection(body);
    if (until > 5.0 && std::abs(now - settled) < 1e-6 * now) return now;
    settled = now;
  }
  ADD_FAILURE() << "does not settle";
  return 0.0;
}

struct Found {
  std::array<double, 3> deflection;  ///< m, 2, 4, 8 quads through the thickness
  [[nodiscard]] double order() const {
    return std::log2((deflection[1] - deflection[0]) / (deflection[2] - deflection[1]));
  }
  [[nodiscard]] double limit() const { return deflection[2] + (deflection[2] - deflection[1]) / 3.0; }
};

Found series(double thickness) {
  return {{deflection(thickness, 2), deflection(thickness, 4), deflection(thickness, 8)}};
}

verification::Comparison comparison(const std::string& quantity) {
  verification::Comparison result;
  result.group = "convergence";
  result.name = "Clamped beam under uniform pressure, at rest";
  result.quantity = quantity;
  result.reference = "closed form";
  result.origin = "Timoshenko beam: q l^4/(384 E' I) + q l^2/(8 k G A), E' = E/(1 - nu^2), k = 5/6";
  return result;
}

TEST(FeBeamStatic, DeflectionConvergesToTimoshenko) {
  constexpr double kThick = 0.02, kSlender = 0.01;
  const Found slender = series(kSlender);
  const Found thick = series(kThick);
  verification::Comparison limit = comparison("mid-span deflection, limit of the mesh, thickness 1/40 of the span");
  limit.unit = "m";
  limit.expected = timoshenko(kSlender);
  limit.found = slender.limit();
  limit.tolerance = 5e-3;
  limit.reason = "model: a held face cannot contract, which shortens the beam by some 3% of its thickness";
  verification::check(limit);
  verification::Comparison order = comparison("order in the mesh, 2, 4, 8 quads through the thickness");
  order.reference = "order of the elements";
  order.origin = "constant-strain triangles: energies converge with h^2";
  order.expected = 2.0;
  order.found = slender.order();
  order.tolerance = 0.15;
  order.reason = "discretisation: the corners of the clamps are singular (stress r^-0.29), a small part of order 1.4";
  verification::check(order);
  verification::Comparison scaling = comparison("difference of the limits at 1/20 of the span over that at 1/40");
  scaling.reference = "scaling of the model's error";
  scaling.origin = "a shortening in proportion to the thickness";
  scaling.expected = 2.0;
  scaling.found = (thick.limit() / timoshenko(kThick) - 1.0) / (slender.limit() / timoshenko(kSlender) - 1.0);
  scaling.tolerance = 0.1;
  scaling.reason = "model: next order of thickness over span";
  verification::check(scaling);
}

}  // namespace
}  // namespace grainstep::fe
