/// @file One comparison of the verification page (docs/verification.md): checked like any other expectation, and
/// written down where GRAINSTEP_VERIFICATION_DIR says. tools/verification-page makes the page;
/// tests/verification/record.py is the same for Python.
#pragma once

#include <cmath>
#include <string>
#include <vector>

namespace grainstep::verification {

struct Comparison {
  std::string group;      ///< "particles", "contact", "structure", "coupled", "hard cases" or "convergence"
  std::string name;       ///< of the case; comparisons of one name stand together
  std::string quantity;   ///< what is compared
  std::string unit;       ///< SI; empty where it has none
  std::string reference;  ///< what it is compared with: "closed form", "ODE integration", ...
  std::string origin;     ///< where that comes from: formula, equation number, figure, script
  double expected = 0.0;
  double found = 0.0;
  double tolerance = 0.0;  ///< relative to |expected|; absolute, in `unit`, where `expected` is zero
  std::string reason;      ///< class of the tolerance (exact, discretisation, model, statistics) and why
};

/// Largest |found - expected| that passes.
[[nodiscard]] double allowed(const Comparison& comparison);

/// Expects |found - expected| <= allowed(comparison) (a NaN fails) and records it. Throws std::invalid_argument for an
/// unknown group.
void check(const Comparison& comparison);

/// The larger of two, and not a number if one of them is: for the largest error of many.
[[nodiscard]] inline double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }

struct Series {
  enum class Mark { points, line };
  std::string label;
  std::vector<double> x, y;  ///< of equal length
  Mark mark = Mark::points;
};

/// A plot below its case: written as CSV (series, x, y), drawn by tools/verification-page.
struct Curve {
  enum class Axes { linear, log_log, log_x, log_y };
  std::string group, name;  ///< of the case
  std::string title;
  std::string x_label, y_label;
  Axes axes = Axes::linear;
  std::vector<Series> series;
};

void curve(const Curve& curve);

}  // namespace grainstep::verification
