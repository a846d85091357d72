#include "ledger/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>

#include "ledger/observables.hpp"

namespace grainstep::ledger {
namespace {

Vector vector_of(const google::protobuf::RepeatedField<double>& values) {
  Vector out{};
  std::copy_n(values.begin(), std::min<int>(values.size(), 3), out.begin());
  return out;
}

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
double length(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }

constexpr double not_judged = std::numeric_limits<double>::quiet_NaN();

/// In size, of those that are judged; not a number where one of these is none.
double largest_judged(std::initializer_list<std::optional<double>> parts) {
  double largest = 0.0;
  for (const std::optional<double>& part : parts) {
    if (part && !(std::abs(*part) <= largest)) largest = std::abs(*part);
    if (std::isnan(largest)) return largest;
  }
  return largest;
}

std::optional<double> judged_if(bool judged, double value) { return judged ? std::optional(value) : std::nullopt; }

// How far `value` lies outside the interval between two ends, given in either order.
double outside(double value, double one_end, double other_end) {
  const auto [low, high] = std::minmax(one_end, other_end);
  return std::max({0.0, low - value, value - high});
}

}  // namespace

double energy_of(const wire::Energy& e) {
  return e.kinetic() + e.elastic() + e.plastic() + e.damping() + e.friction() + e.viscous() - e.support_work();
}

namespace {

double own_energy(const wire::Energy& e) { return energy_of(e) - e.interface_work(); }

/// `error` over `reference`, also where there is none: then any error is all that there is.
double part_of(double reference, double error) {
  if (reference > 0.0) return error / reference;
  return error == 0.0 ? 0.0 : std::copysign(1.0, error);
}

constexpr double measuring_windows = 10.0;

/// N s: the most that a mass with this kinetic energy can have.
double largest_momentum(double mass, const wire::Energy& energy) {
  return std::sqrt(2.0 * mass * std::max(0.0, energy.kinetic()));
}

}  // namespace

Ledger::Ledger(const wire::Report& impactor, const wire::Report& structure, bool equal_steps, const Masses& masses,
               const Levels& levels)
    : impactor_start_(impactor.momentum()),
      structure_start_(structure.momentum()),
      impactor_start_energy_(own_energy(impactor.energy())),
      structure_start_energy_(own_energy(structure.energy())),
      equal_steps_(equal_steps),
      levels_(levels),
      initial_energy_(energy_of(impactor.energy()) + energy_of(structure.energy())),
      momentum_reference_(
          std::max(length(plus(vector_of(impactor_start_.linear()), vector_of(structure_start_.linear()))),
                   largest_momentum(masses.impactor, impactor.energy()) +
                       largest_momentum(masses.structure, structure.energy()))) {}

double Ledger::relative(double momentum) const { return part_of(momentum_reference_, momentum); }

Closure Ledger::side(const wire::Momentum& now, const wire::Momentum& start, wire::Ledger level) const {
  Closure out;
  out.change = minus(vector_of(now.linear()), vector_of(start.linear()));
  out.interface = minus(vector_of(now.interface_impulse()), vector_of(start.interface_impulse()));
  out.support = minus(vector_of(now.support_impulse()), vector_of(start.support_impulse()));
  const double error = relative(length(minus(out.change, plus(out.interface, out.support))));
  out.error = level == wire::FULL ? error : not_judged;
  return out;
}

// The structure has taken up everything of the earlier windows and a part of this one's. So has the impactor if a
// window is one step of it; otherwise its last step, half of which is still to come, can differ from the window's sum
// by its own sign, and all that the messages say is that it is no more than a window's worth.
double Ledger::interface_excess(const Balance& balance, const HandedOver& handed_over) const {
  const Vector total = handed_over.total();
  const double slack = equal_steps_ ? 0.0 : handed_over.peak;
  Vector excess{};
  for (std::size_t i = 0; i < excess.size(); ++i) {
    const double taken = outside(balance.structure.interface[i], handed_over.before[i], total[i]);
    const double low = std::min(handed_over.before[i], total[i]) - slack;
    const double high = std::max(handed_over.before[i], total[i]) + slack;
    excess[i] = std::max(taken, outside(-balance.impactor.interface[i], low, high));
  }
  return relative(length(excess));
}

Balance Ledger::close(const wire::Report& impactor, const wire::Report& structure, const HandedOver& handed_over) {
  momentum_reference_ = std::max(momentum_reference_, length(handed_over.total()));
  Balance out;
  out.momentum_reference = momentum_reference_;
  out.impactor = side(impactor.momentum(), impactor_start_, levels_.impactor);
  out.structure = side(structure.momentum(), structure_start_, levels_.structure);
  const Vector given = minus(Vector{}, out.impactor.interface);
  out.in_flight = minus(given, out.structure.interface);
  const Vector change = plus(out.impactor.change, out.structure.change);
  const Vector supports = plus(out.impactor.support, out.structure.support);
  const double whole = relative(length(plus(minus(change, supports), out.in_flight)));
  out.interface_momentum = interface_excess(out, handed_over);
  out.momentum_error = largest_judged({judged_if(levels_.full(), whole), out.interface_momentum,
                                       judged_if(levels_.impactor == wire::FULL, out.impactor.error),
                                       judged_if(levels_.structure == wire::FULL, out.structure.error)});
  close_energy(impactor, structure, handed_over.acting, out);
  return out;
}

// The whole's change is the sum of the sides' errors and the mismatch, each of its own sign: the contacts' integration
// loses what unequal steps at the interface may give back. So each has to be small by itself.
void Ledger::close_energy(const wire::Report& impactor, const wire::Report& structure, std::uint64_t acting,
                          Balance& out) {
  // Work on particles and work on the surface differ by what the contacts between them dissipate and store.
  const double given_work = find(impactor, observable::work_on_surface).value_or(-impactor.energy().interface_work());
  const double taken_work = structure.energy().interface_work();
  supplied_ = std::max(supplied_, std::abs(impactor.energy().support_work() + structure.energy().support_work()));
  const double growth = std::max(1.0, measuring_windows / static_cast<double>(std::max<std::uint64_t>(1, acting)));
  // Where a side's own energy is not known, what passes the surface is all that there is to measure with.
  if (!levels_.full()) supplied_ = std::max({supplied_, std::abs(given_work), std::abs(taken_work)});
  out.energy_reference = supplied_ > initial_energy_ ? supplied_ * growth : initial_energy_;
  out.energy = energy_of(impactor.energy()) + energy_of(structure.energy());
  out.energy_change = part_of(out.energy_reference, out.energy - initial_energy_);
  out.impactor_energy = part_of(out.energy_reference, own_energy(impactor.energy()) - impactor_start_energy_);
  out.structure_energy = part_of(out.energy_reference, own_energy(structure.energy()) - structure_start_energy_);
  out.interface_mismatch = given_work - taken_work;
  const bool impactor_judged = levels_.impactor == wire::FULL;
  const bool structure_judged = levels_.structure == wire::FULL;
  out.energy_drift = largest_judged(
      {judged_if(levels_.full(), out.energy_change), judged_if(impactor_judged, out.impactor_energy),
       judged_if(structure_judged, out.structure_energy), part_of(out.energy_reference, out.interface_mismatch)});
  if (!levels_.full()) out.energy = out.energy_change = not_judged;
  if (!impactor_judged) out.impactor_energy = not_judged;
  if (!structure_judged) out.structure_energy = not_judged;
}

}  // namespace grainstep::ledger
