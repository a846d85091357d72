#include "orchestrator/conformance/books.hpp"

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "ledger/ledger.hpp"
#include "orchestrator/conformance/trial.hpp"

namespace grainstep::conformance {
namespace {

std::string at(std::uint64_t window) { return "at window " + std::to_string(window) + ": "; }

/// N s: what differences are measured by.
double largest_impulse(const Played& run) {
  double largest = 0.0;
  for (std::uint64_t n = 0; n < run.forces.size(); ++n) {
    largest = std::max({largest, length(run.given_before(n)), length(run.given_in(n))});
  }
  return largest;
}

}  // namespace

Vector vector_of(const google::protobuf::RepeatedField<double>& values) {
  Vector out{};
  std::copy_n(values.begin(), std::min<int>(values.size(), 3), out.begin());
  return out;
}

double length(const Vector& value) { return std::hypot(value[0], value[1], value[2]); }

void require_full_books(const Subject& subject) {
  if (subject.peer().ready.ledger() != wire::FULL) {
    throw NotOffered("Ready.ledger is INTERFACE: it keeps no books of its own energy and momentum");
  }
}

void require_interface_impulse(const Played& run, double sign, bool exact) {
  const double scale = largest_impulse(run);
  for (const wire::Report& report : run.reports) {
    const std::uint64_t n = report.window();
    const Vector found = vector_of(report.momentum().interface_impulse());
    const Vector before = run.given_before(n);
    const Vector in = run.given_in(n);
    for (std::size_t c = 0; c < 3; ++c) {
      const double low = sign * before[c] + (exact && n > 0 ? 0.5 : 0.0) * sign * in[c];
      const double high = sign * before[c] + (exact ? (n > 0 ? 0.5 : 0.0) : 1.0) * sign * in[c];
      const double slack = round_off * scale;
      if (found[c] >= std::min(low, high) - slack && found[c] <= std::max(low, high) + slack) continue;
      throw Breach(at(n) + "interface_impulse along x" + std::to_string(c + 1) + " is " + rounded_text(found[c]) +
                   " N s; what was handed over makes " + rounded_text(low) +
                   (exact ? "" : " to " + rounded_text(high)) + " N s");
    }
  }
}

void require_momentum(const Subject& subject, const Played& run) {
  require_full_books(subject);
  const auto own = [](const wire::Momentum& m) {
    Vector out = vector_of(m.linear());
    const Vector interface = vector_of(m.interface_impulse());
    const Vector support = vector_of(m.support_impulse());
    for (std::size_t c = 0; c < 3; ++c) out[c] -= interface[c] + support[c];
    return out;
  };
  double scale = largest_impulse(run);
  for (const wire::Report& report : run.reports) scale = std::max(scale, length(vector_of(report.momentum().linear())));
  const Vector start = own(run.reports.front().momentum());
  for (const wire::Report& report : run.reports) {
    const Vector now = own(report.momentum());
    const double lost = length({now[0] - start[0], now[1] - start[1], now[2] - start[2]});
    if (lost <= round_off * scale) continue;
    throw Breach(at(report.window()) + "linear momentum and what it received differ by " + rounded_text(lost) +
                 " N s, with " + rounded_text(scale) + " N s in play");
  }
}

void require_energy(const Subject& subject, const Played& run) {
  require_full_books(subject);
  const auto own = [](const wire::Energy& e) { return ledger::energy_of(e) - e.interface_work(); };
  double scale = 0.0;
  for (const wire::Report& report : run.reports) {
    scale = std::max({scale, std::abs(ledger::energy_of(report.energy())), std::abs(report.energy().interface_work())});
  }
  const double start = own(run.reports.front().energy());
  for (const wire::Report& report : run.reports) {
    const double lost = std::abs(own(report.energy()) - start);
    if (lost <= of_integration * scale) continue;
    throw Breach(at(report.window()) + "its energy and the work done on it differ by " + rounded_text(lost) +
                 " J, with " + rounded_text(scale) + " J in play");
  }
}

}  // namespace grainstep::conformance
