#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "ledger/observables.hpp"
#include "orchestrator/conformance/books.hpp"
#include "orchestrator/conformance/trial.hpp"

namespace grainstep::conformance {
namespace {

constexpr std::uint64_t windows = 200;
constexpr double retreat = -1.0;  // m/s along x2, of a surface that gives way

struct Run {
  explicit Run(const Bench& bench, Plan plan) : subject(bench), played(subject, bench, std::move(plan)) {
    played.run();
  }
  Subject subject;
  Played played;
};

void given(const Bench& bench) { require_interface_impulse(Run(bench, {.windows = windows}).played, -1.0, true); }

void unequal(const Bench& bench) {
  const Run run(bench, {.windows = windows / 4, .steps = 4});
  if (run.subject.peer().ready.ledger() == wire::FULL) require_momentum(run.subject, run.played);
  // Half of its last step still lies ahead at the end of a window: what the messages say is that it is no more than a
  // window's worth, by size.
  double largest = 0.0;
  for (const wire::Forces& forces : run.played.forces) {
    double sizes = 0.0;
    for (const double impulse : forces.impulse()) sizes += std::abs(impulse);
    largest = std::max(largest, sizes);
  }
  for (const wire::Report& report : run.played.reports) {
    const Vector before = run.played.given_before(report.window());
    const Vector in = run.played.given_in(report.window());
    const Vector found = vector_of(report.momentum().interface_impulse());
    Vector off{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double one = -before[c];
      const double other = one - in[c];
      off[c] = std::max({0.0, std::min(one, other) - found[c], found[c] - std::max(one, other)});
    }
    if (length(off) <= largest * (1.0 + round_off)) continue;
    throw Breach("at window " + std::to_string(report.window()) + " interface_impulse and the Forces differ by " +
                 rounded_text(length(off)) + " N s, more than any window's");
  }
}

void momentum(const Bench& bench) {
  const Run run(bench, {.windows = windows});
  require_momentum(run.subject, run.played);
}

void energy(const Bench& bench) {
  const Run run(bench, {.windows = windows});
  require_energy(run.subject, run.played);
}

/// Of a rigid surface that moves evenly the work is its velocity times the impulse.
void work(const Bench& bench) {
  const Run run(bench, {.windows = windows, .surface_velocity = {0.0, retreat, 0.0}});
  double scale = 0.0;
  for (std::uint64_t n = 0; n < run.played.forces.size(); ++n) {
    scale = std::max({scale, std::abs(run.played.given_before(n)[1]), std::abs(run.played.given_in(n)[1])});
  }
  for (const wire::Report& report : run.played.reports) {
    const auto found = ledger::find(report, ledger::observable::work_on_surface);
    if (!found) throw NotOffered("it does not report work_on_surface");
    const std::uint64_t n = report.window();
    const double up_to_now = run.played.given_before(n)[1] + (n == 0 ? 0.0 : 0.5) * run.played.given_in(n)[1];
    if (std::abs(*found - retreat * up_to_now) <= 1e-6 * std::abs(retreat) * scale) continue;
    throw Breach("at window " + std::to_string(n) + " work_on_surface is " + rounded_text(*found) +
                 " J; velocity times impulse makes " + rounded_text(retreat * up_to_now) + " J");
  }
}

/// What is handed over depends on how fast the surface gives way: less, where it flees.
void motion(const Bench& bench) {
  const Run still(bench, {.windows = windows});
  const Run fleeing(bench, {.windows = windows, .surface_velocity = {0.0, 10.0 * retreat, 0.0}});
  const double first = -still.played.given_before(windows)[1];
  const double second = -fleeing.played.given_before(windows)[1];
  if (first == 0.0)
    throw NotOffered("it does not touch a surface at rest within " + std::to_string(windows) + " steps");
  if (first == second) throw Breach("a surface that gives way receives what one at rest does: it takes no notice");
}

void prescribed_motion(const Bench& bench) {
  const auto type = bench.scene.impactor().type();
  if (type == scene::Impactor::TYPE_PRESSURE || type == scene::Impactor::TYPE_NONE) {
    throw NotOffered("a prescribed load does not depend on the surface's motion");
  }
  motion(bench);
}

void schedule(const Bench& bench) {
  const Run run(bench, {.windows = 23, .report_every = 2.6, .snapshot_every = 7.3});
  if (run.played.snapshots.empty()) throw Breach("sent no snapshot");
}

}  // namespace

std::vector<Trial> impactor_trials() {
  return {
      {"given", "It books every impulse that it gives, half of it before and half after the end of the window.",
       "Forces", given},
      {"unequal", "With several of its steps in a window the sums are the same.", "Steps", unequal},
      {"momentum", "Its momentum is what it received, to round-off.", "Report", momentum},
      {"energy", "Its energy is the work that was done on it.", "Report", energy},
      {"work", "On a surface that moves evenly, work is velocity times impulse.", "Report", work},
      {"motion", "What it gives depends on the motion of the surface.", "Kinematics", prescribed_motion},
      {"schedule", "Reports and snapshots come when they are due, with names and sizes that can be recorded.", "Order",
       schedule},
  };
}

}  // namespace grainstep::conformance
