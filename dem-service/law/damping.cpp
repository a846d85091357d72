#include "dem-service/law/damping.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/error.hpp"

namespace grainstep::dem {
namespace {

// In a contact: dashpots are tried in so many steps at most, which takes 15 ms.
constexpr double steps_of_finest = 256.0;

/// Whether the steps of a contact, overlap and rate in the units below, have two real, positive factors: it creeps out.
bool is_overdamped(double spring, double dashpot) {
  const double trace = 2.0 - spring - dashpot;
  const double determinant = 1.0 - dashpot;
  return trace > 0.0 && determinant >= 0.0 && trace * trace >= 4.0 * determinant;
}

/// Departure over approach speed, for a first overlap of `phase` times one step's way.
/// In units of the approach speed v and the step: overlap u = delta/(v dt), rate w = delta_dot/v.
double departure(double spring, double dashpot, bool tension_cutoff, double phase) {
  // One that is nearly overdamped ends after very many steps. Neither its rate nor what changes it is left then; the
  // rate alone is next to nothing where any other contact turns round.
  constexpr double creeping = 1e-7;  // of the approach speed
  double overlap = phase;
  double rate = 1.0;
  while (rate >= 0.0 || rate <= -creeping || spring * overlap >= creeping) {
    double force = spring * overlap + dashpot * rate;
    if (tension_cutoff && force < 0.0) force = 0.0;
    rate -= force;
    overlap += rate;
    if (overlap <= 0.0) return -rate;
  }
  return 0.0;
}

}  // namespace

double continuum_damping(const Collision& collision) {
  if (collision.restitution >= 1.0) return 0.0;
  const double ratio = std::numbers::pi / std::log(collision.restitution);
  return std::sqrt(4.0 * collision.stiffness / (collision.effective_mass * (1.0 + ratio * ratio)));
}

double contact_time(const Collision& collision) {
  if (collision.restitution >= 1.0) {
    return std::numbers::pi * std::sqrt(collision.effective_mass / collision.stiffness);
  }
  return -2.0 * std::log(collision.restitution) / continuum_damping(collision);
}

double discrete_restitution(const Collision& collision, double gamma, double dt) {
  constexpr int phases = 400;
  const double spring = collision.stiffness / collision.effective_mass * dt * dt;
  if (!collision.tension_cutoff && is_overdamped(spring, gamma * dt)) return 0.0;
  double sum = 0.0;
  for (int i = 0; i < phases; ++i) {
    sum += departure(spring, gamma * dt, collision.tension_cutoff, (i + 0.5) / phases);
  }
  return sum / phases;
}

namespace {

/// By trying, whatever it takes.
double searched_damping(const Collision& collision, double dt, double tolerance) {
  const double most = 1.0 / dt;  // the dashpot takes the whole approach rate in one step: beyond it, it would overshoot
  double low = 0.0;
  double high = std::min(most, continuum_damping(collision));
  while (high < most && discrete_restitution(collision, high, dt) > collision.restitution) {
    low = high;
    high = std::min(most, 1.25 * high);
  }
  if (discrete_restitution(collision, high, dt) > collision.restitution) {
    std::ostringstream text;
    text << "restitution " << collision.restitution << " cannot be reached with a step of " << dt << " s (contact time "
         << contact_time(collision) << " s): take a smaller steps.impactor";
    throw InputError(text.str());
  }
  for (int i = 0; i < 60 && high - low > tolerance * high; ++i) {
    const double middle = 0.5 * (low + high);
    (discrete_restitution(collision, middle, dt) > collision.restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double calibrated_damping(const Collision& collision, double dt, double tolerance) {
  if (collision.restitution >= 1.0) return 0.0;
  const double finest = contact_time(collision) / steps_of_finest;
  if (dt >= finest) return searched_damping(collision, dt, tolerance);
  // It differs from that of a vanishing step by the step's first power, and 4e-5 of it by higher ones.
  const double there = searched_damping(collision, finest, tolerance);
  const double vanishing = collision.tension_cutoff ? 2.0 * there - searched_damping(collision, 2.0 * finest, tolerance)
                                                    : continuum_damping(collision);
  return vanishing + (there - vanishing) * dt / finest;
}

contact::DampingTable damping_table(const Collision& lightest, double heaviest, double dt) {
  constexpr int last = contact::DampingTable::nodes - 1;
  constexpr double tolerance = 1e-6;  // the phases tried leave 1e-4
  contact::DampingTable table;
  table.scale = dt * std::sqrt(lightest.stiffness);
  table.first = table.scale / std::sqrt(heaviest);
  const double spacing = (table.scale / std::sqrt(lightest.effective_mass) - table.first) / last;
  table.per_spacing = 1.0 / spacing;
  for (int i = 0; i <= last; ++i) {
    const double x = table.first + i * spacing;
    Collision collision = lightest;
    collision.effective_mass = table.scale * table.scale / (x * x);
    table.value[i] = calibrated_damping(collision, dt, tolerance) / x;
  }
  table.value[last + 1] = table.value[last];
  return table;
}

}  // namespace grainstep::dem
