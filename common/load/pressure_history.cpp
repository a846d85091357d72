#include "load/pressure_history.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/assert.hpp"
#include "base/error.hpp"

namespace grainstep::load {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();
constexpr double never = std::numeric_limits<double>::quiet_NaN();

double end_of(const scene::RectangularPulse& pulse) { return pulse.has_duration() ? pulse.duration() : forever; }

double impulse(const scene::RectangularPulse& pulse, double from, double to) {
  return pulse.pressure() * std::max(0.0, std::min(to, end_of(pulse)) - std::max(from, 0.0));
}

double pressure_at(const scene::RectangularPulse& pulse, double time) {
  return time >= 0.0 && time < end_of(pulse) ? pulse.pressure() : 0.0;
}

Moments moments(const scene::RectangularPulse& pulse) {
  return {.impulse = pulse.pressure() * end_of(pulse),
          .mean_time = 0.5 * end_of(pulse),
          .onset = pulse.pressure() != 0.0 ? 0.0 : never,
          .end = end_of(pulse)};
}

double impulse(const scene::ExponentialPulse& pulse, double from, double to) {
  const double start = std::max(from, 0.0);
  if (to <= start) return 0.0;
  const double tau = pulse.decay_time();
  return pulse.peak() * tau * std::exp(-start / tau) * -std::expm1(-(to - start) / tau);
}

double pressure_at(const scene::ExponentialPulse& pulse, double time) {
  return time >= 0.0 ? pulse.peak() * std::exp(-time / pulse.decay_time()) : 0.0;
}

Moments moments(const scene::ExponentialPulse& pulse) {
  return {.impulse = pulse.peak() * pulse.decay_time(),
          .mean_time = pulse.decay_time(),
          .onset = pulse.peak() != 0.0 ? 0.0 : never,
          .end = forever};
}

/// A straight piece of a table.
struct Piece {
  double start, end;   // s
  double first, last;  // Pa, at its ends
  [[nodiscard]] double at(double time) const { return first + (last - first) * (time - start) / (end - start); }
};

Piece piece(const scene::TabulatedPulse& table, int k) {
  return {table.time(k), table.time(k + 1), table.pressure(k), table.pressure(k + 1)};
}

double impulse(const scene::TabulatedPulse& table, double from, double to) {
  double sum = 0.0;
  for (int k = 0; k + 1 < table.time_size(); ++k) {
    const Piece line = piece(table, k);
    const double a = std::max(from, line.start);
    const double b = std::min(to, line.end);
    if (b > a) sum += 0.5 * (line.at(a) + line.at(b)) * (b - a);
  }
  return sum;
}

double pressure_at(const scene::TabulatedPulse& table, double time) {
  for (int k = 0; k + 1 < table.time_size(); ++k) {
    const Piece line = piece(table, k);
    if (time >= line.start && time < line.end) return line.at(time);
  }
  return 0.0;
}

Moments moments(const scene::TabulatedPulse& table) {
  Moments sum;
  sum.onset = sum.end = never;
  double moment = 0.0;
  for (int k = 0; k + 1 < table.time_size(); ++k) {
    const Piece p = piece(table, k);
    if (p.first != 0.0 || p.last != 0.0) {
      if (!(sum.onset <= p.start)) sum.onset = p.start;
      sum.end = p.end;
    }
    const double width = p.end - p.start;
    sum.impulse += 0.5 * (p.first + p.last) * width;
    moment += width / 6.0 * (p.start * (2.0 * p.first + p.last) + p.end * (p.first + 2.0 * p.last));
  }
  sum.mean_time = moment / sum.impulse;
  return sum;
}

/// Calls action with the history that is set.
template <class Action>
auto of_history(const scene::Pressure& pressure, Action action) {
  switch (pressure.history_case()) {
    case scene::Pressure::kRectangular:
      return action(pressure.rectangular());
    case scene::Pressure::kExponential:
      return action(pressure.exponential());
    case scene::Pressure::kTabulated:
      return action(pressure.tabulated());
    case scene::Pressure::HISTORY_NOT_SET:
      break;
  }
  assertion_failed("a history", __FILE__, __LINE__, "a pressure without a history passed the rules");
}

}  // namespace

void require_history(const scene::Pressure& pressure) {
  if (pressure.history_case() == scene::Pressure::HISTORY_NOT_SET)
    throw InputError("impactor.pressure: needs a history: one of rectangular, exponential, tabulated");
  const scene::TabulatedPulse& table = pressure.tabulated();
  if (table.time_size() != table.pressure_size()) {
    throw InputError("impactor.pressure.tabulated.pressure: " + std::to_string(table.pressure_size()) +
                     " pressures for " + std::to_string(table.time_size()) + " times; expected one for each");
  }
  for (int k = 0; k + 1 < table.time_size(); ++k) {
    if (table.time(k) < table.time(k + 1)) continue;
    throw InputError("impactor.pressure.tabulated.time." + std::to_string(k + 1) + ": times must increase strictly");
  }
}

double impulse(const scene::Pressure& pressure, double from, double to) {
  return of_history(pressure, [&](const auto& history) { return impulse(history, from, to); });
}

double pressure_at(const scene::Pressure& pressure, double time) {
  return of_history(pressure, [&](const auto& history) { return pressure_at(history, time); });
}

Moments moments(const scene::Pressure& pressure) {
  return of_history(pressure, [](const auto& history) { return moments(history); });
}

}  // namespace grainstep::load
