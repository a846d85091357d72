// Drift of the particles' energy ledger on a rigid wall, every step sampled. docs/theory/contact.md says why it is of
// second order: only springs that begin or end between two steps are counted wrongly, dashpots are not.
#include <gtest/gtest.h>

#include <cmath>

#include "../unit/dem-service/engine_rig.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

double total(const wire::Energy& e) {
  return e.kinetic() + e.elastic() + e.damping() + e.friction() - e.interface_work() - e.support_work();
}

/// Relative loss of the ledger over 0.6 H/v0, mean of a few packings.
double drift(double steps_per_contact) {
  double sum = 0.0;
  constexpr int seeds = 3;
  for (int seed = 1; seed <= seeds; ++seed) {
    wire::Setup setup = reference_setup();
    setup.set_mirror(true);
    slug_of(setup).set_seed(static_cast<std::uint64_t>(seed));
    set_flat_surface(setup, 0.2, 60);
    const SlugModel model = model_of(setup);
    const double dt = model.contact_time / steps_per_contact;
    const ScriptedLink link =
        run_slug(setup, start_of(dt, static_cast<std::uint64_t>(0.6 * model.height / model.speed / dt)));
    const double before = total(link.reports.front().energy());
    sum += (before - total(link.reports.back().energy())) / before / seeds;
  }
  return sum;
}

verification::Comparison order(const std::string& quantity, double found) {
  return {.group = "convergence",
          .name = "energy ledger of the particles",
          .quantity = quantity,
          .unit = "",
          .reference = "order of the trapezoidal rule over springs that begin or end between steps",
          .origin = "docs/theory/contact.md",
          .expected = 2.0,
          .found = found,
          .tolerance = 0.15,
          .reason = "statistics: some hundred collisions, another realisation for every step"};
}

TEST(DemEnergyOrder, LedgerDriftIsOfSecondOrder) {
  const double at_10 = drift(10.0);
  const double at_20 = drift(20.0);
  const double at_40 = drift(40.0);
  EXPECT_GT(at_10, 0.0);
  EXPECT_LT(at_10, 0.012);
  verification::check(order("order of the drift, t_e/10 to t_e/20", std::log2(at_10 / at_20)));
  verification::check(order("order of the drift, t_e/20 to t_e/40", std::log2(at_20 / at_40)));
  verification::curve(
      {.group = "convergence",
       .name = "energy ledger of the particles",
       .title = "drift of the ledger",
       .x_label = "dt / t_e",
       .y_label = "energy lost / initial energy",
       .axes = verification::Curve::Axes::log_log,
       .series = {{"found", {0.1, 0.05, 0.025}, {at_10, at_20, at_40}},
                  {"second order", {0.1, 0.025}, {at_20 * 4.0, at_20 / 4.0}, verification::Series::Mark::line}}});
}

}  // namespace
}  // namespace grainstep::dem
