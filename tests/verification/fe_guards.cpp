// Blows on one node: a sudden one turns the elements below it inside out, a growing push draws them out into needles of
// unchanged area. Either ends the run there and then, and the place is named.
#include <gtest/gtest.h>

#include <regex>

#include "../support/fe_scenes.hpp"
#include "base/error.hpp"
#include "fe-service/structure.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

struct Named {
  double column = -1.0, row = -1.0;  ///< of the quad in the message
  double time = -1.0;                ///< s
  double last_quality = 1.0;         ///< of the last report before
  std::uint64_t window = 0;          ///< that was under way
  double length = 0.0;               ///< of a window, s
};

/// Impulse on one node of the loaded face in a window, N s.
using Blow = double (*)(std::uint64_t window);

/// Strikes until an element gives way.
Named strike(int node, Blow blow) {
  Structure structure;
  const wire::Ready ready = structure.prepare(test::setup_of(test::beam(scene::Layer::MATERIAL_DH36, 0.1, 0.02, 3)));
  wire::Start start;
  start.set_window(ready.preferred_step());
  start.set_windows(1000);
  start.set_impactor_steps(1);
  start.set_structure_steps(1);
  structure.start(start);
  Named result;
  result.length = start.window();
  wire::Report report;
  try {
    for (; result.window < 1000; ++result.window) {
      wire::Forces forces;
      forces.set_window(result.window);
      for (int i = 0; i < ready.surface().position_size(); ++i) {
        forces.add_impulse(i == 2 * node + 1 ? -blow(result.window) : 0.0);
      }
      wire::Kinematics next;
      structure.advance(forces, {.report = true}, next);
      structure.report(report);
      for (const wire::Observable& observable : report.observable()) {
        if (observable.name() == "min_element_quality") result.last_quality = observable.value();
      }
      structure.complete();
    }
    ADD_FAILURE() << "not noticed";
  } catch (const NumericalError& error) {
    const std::string text = error.what();
    std::smatch found;
    const std::regex place(R"(element quality: .*quad \(column (\d+), row (\d+)\).*\(t = (\S+) s; the last)");
    if (std::regex_search(text, found, place)) {
      result.column = std::stod(found[1]);
      result.row = std::stod(found[2]);
      result.time = std::stod(found[3]);
    } else {
      ADD_FAILURE() << text;
    }
  }
  return result;
}

void check(int node, const std::string& name, const std::string& origin, const Named& found) {
  const auto one = [&](const std::string& quantity, const std::string& unit, double expected, double value,
                       double tolerance, const std::string& reason) {
    verification::check({.group = "hard cases",
                         .name = name,
                         .quantity = "node " + std::to_string(node) + ": " + quantity,
                         .unit = unit,
                         .reference = "where and when it was struck",
                         .origin = origin,
                         .expected = expected,
                         .found = value,
                         .tolerance = tolerance,
                         .reason = reason});
  };
  one("columns between the blow and the quad named", "", 0.0, found.column + 0.5 - node, 0.5,
      "exact: one of the two quads at the node");
  one("row of the quad named", "", 0.0, found.row, 0.0, "exact: the first");
  one("time named / window under way", "windows", static_cast<double>(found.window + 1), found.time / found.length,
      1e-5, "exact: the first forces after the blow; six digits are printed");
  EXPECT_GE(found.last_quality, 0.01);  // nothing beyond the guard has been reported
}

class FeGuards : public testing::TestWithParam<int> {};

TEST_P(FeGuards, InvertedElementIsNamedAtOnce) {
  const Named found = strike(GetParam(), [](std::uint64_t) { return 0.1; });
  check(GetParam(), "sudden blow on one node of the loaded face", "0.1 N s a window on that node alone", found);
  EXPECT_LT(found.window, 10U);
}

TEST_P(FeGuards, NeedlesEndTheRun) {
  const Named found = strike(GetParam(), [](std::uint64_t window) { return 2e-4 * static_cast<double>(window); });
  check(GetParam(), "growing push on one node of the loaded face", "0.2 mN s more in every window on that node alone",
        found);
  EXPECT_GT(found.last_quality, 0.1);  // area alone would not have shown it
}

INSTANTIATE_TEST_SUITE_P(Nodes, FeGuards, testing::Values(4, 12, 25));

}  // namespace
}  // namespace grainstep::fe
