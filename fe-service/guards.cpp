#include "fe-service/guards.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace grainstep::fe {

namespace {

struct Found {
  int row = 0, column = 0, triangle = 0;
  double value = HUGE_VAL;
};

/// The triangle with the smallest value of measure(row, column, triangle); one that is not a number wins.
template <class Measure>
Found smallest(const Body& body, Measure measure) {
  Found found;
  for (int row = 0; row < body.mesh().row_count(); ++row) {
    for (int column = 0; column < body.mesh().columns; ++column) {
      for (int triangle = 0; triangle < kQuadTriangles; ++triangle) {
        const double value = measure(row, column, triangle);
        if (!(value >= found.value) && !std::isnan(found.value)) found = {row, column, triangle, value};
      }
    }
  }
  return found;
}

std::string name_of_quad(const Body& body, const Found& element) {
  const Vec2 centre = body.triangle(element.row, element.column, 0).centre;
  return fmt::format("quad (column {}, row {}), layer {}, now at x1 = {:.6g} m, x2 = {:.6g} m", element.column,
                     element.row, body.mesh().rows[element.row].layer, centre.x, centre.y);
}

std::string name_of(const Body& body, const Found& element) {
  static constexpr const char* kNames[] = {"lower", "right", "upper", "left"};
  return fmt::format("the {} triangle of {}", kNames[element.triangle], name_of_quad(body, element));
}

std::string when(const Progress& progress) {
  return fmt::format("at {} step {} (t = {:.6g} s; the last state that passed all checks is t = {:.6g} s)",
                     progress.body, progress.step, progress.time, progress.last_good_time);
}

/// The quad with the smallest stable step, and that step.
Found stiffest_quad(const Body& body) {
  Found worst;
  for (int row = 0; row < body.mesh().row_count(); ++row) {
    for (int column = 0; column < body.mesh().columns; ++column) {
      const double value = body.stable_step(row, column);
      if (value < worst.value) worst = {row, column, 0, value};
    }
  }
  return worst;
}

}  // namespace

void check_quality(const Body& body, double limit, const Progress& progress) {
  const Found worst = smallest(body, [&body](int row, int column, int triangle) {
    return body.triangle(row, column, triangle).area() / (0.25 * body.mesh().rows[row].quad_area);
  });
  if (worst.value >= limit) return;
  throw NumericalError(fmt::format(
      "element quality: {} has {:.3g} of its undeformed area{}, below guards.element_quality = {:g}, {}; refine the "
      "mesh ({}), take smaller steps ({}), or check speed and stiffness of the impact",
      name_of(body, worst), worst.value, worst.value <= 0.0 ? " (it is turned inside out)" : "", limit, when(progress),
      progress.mesh_key, progress.step_key));
}

void check_finite(const Body& body, const Progress& progress) {
  for (const Nodes* nodes : {&body.corners, &body.centres}) {
    for (std::size_t i = 0; i < nodes->x.size(); ++i) {
      if (std::isfinite(nodes->x[i] + nodes->y[i] + nodes->u[i] + nodes->v[i])) continue;
      throw NumericalError(
          fmt::format("not a number: {} node that was at x1 = {:.6g} m, x2 = {:.6g} m, {}; the step was unstable or "
                      "the forces were "
                      "not finite: take smaller steps (steps.structure, steps.impactor)",
                      nodes == &body.corners ? "corner" : "centre", nodes->x0[i], nodes->y0[i], when(progress)));
    }
  }
}

void check_slivers(const Body& body, double undeformed_step, double limit, const Progress& progress) {
  const Found worst = stiffest_quad(body);
  if (worst.value >= limit * undeformed_step) return;
  throw NumericalError(
      fmt::format("element quality: {} is drawn out so thin that it allows {:.3g} of the undeformed mesh's step, below "
                  "guards.element_quality = {:g}, {}; the run would not end: refine the mesh ({}), or check "
                  "speed and stiffness of the impact",
                  name_of_quad(body, worst), worst.value / undeformed_step, limit, when(progress), progress.mesh_key));
}

void check_fixed_step(const Body& body, double step, const Progress& progress) {
  const Found worst = stiffest_quad(body);
  if (worst.value >= step) return;
  throw NumericalError(
      fmt::format("unstable step: steps.structure fixes it at {:.4g} s, but {} allows {:.4g} s, {}; set "
                  "steps.structure to auto, which "
                  "takes smaller steps where needed, or fix a smaller one",
                  step, name_of_quad(body, worst), worst.value, when(progress)));
}

std::uint32_t steps_needed(double window, double longest, const Progress& progress) {
  constexpr double most = 1e9;
  const double needed = std::ceil(window / longest);
  if (needed <= most) return static_cast<std::uint32_t>(needed);
  throw NumericalError(fmt::format(
      "stable step: a window of {:.4g} s would take {:.4g} steps of {:.4g} s, {}; the run would not end: ask "
      "for shorter windows, or check the density and stiffness of what is computed",
      window, needed, longest, when(progress)));
}

void material_failed(const Body& body, const Progress& progress) {
  check_finite(body, progress);
  throw NumericalError(
      fmt::format("plastic flow: the local iteration of the material did not converge {}; take smaller steps ({})",
                  when(progress), progress.step_key));
}

}  // namespace grainstep::fe
