// A collision may not give energy, least of all at grazing angles, where much tangential motion meets little normal
// force (some LAMMPS versions gave up to 34% in fix wall/gran).
#include <gtest/gtest.h>

#include <numbers>

#include "impacts.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using namespace impacts;

constexpr double radius = 0.5e-3;
constexpr double speed = 10.0;

/// From grazing to head-on, without spin and with the rim moving against and along at full speed. The line of centres
/// of a pair turns: below half a degree two discs that nearly touch pass each other.
std::vector<Motion2> impacts_of(Partner partner) {
  std::vector<Motion2> all;
  for (const double degrees : {0.01, 0.03, 0.1,  0.2,  0.5,  1.0,  2.0,  3.0,  5.0,  7.0, 10.0,
                               15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 89.0}) {
    if (partner == Partner::particle && degrees < 0.5) continue;
    const double angle = degrees * std::numbers::pi / 180.0;
    for (const double rim : {-1.0, 0.0, 1.0}) {
      all.push_back({speed * std::sin(angle), speed * std::cos(angle), rim * speed / radius});
    }
  }
  return all;
}

struct Gain {
  double single = 0.0;  ///< largest of any impact and phase, over the energy before
  double mean = 0.0;    ///< largest of any impact, mean over the phase of entry
};

Gain gain_of(double restitution, Partner partner, bool lever_is_radius) {
  const std::vector<Motion2> before = impacts_of(partner);
  const auto after = rebounds({.restitution = restitution, .lever_is_radius = lever_is_radius}, partner, before, {});
  Gain gain;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double energy = specific_energy(before[i], radius);
    double mean = 0.0;
    for (const Motion2& one : after[i]) {
      EXPECT_GT(one.normal, -before[i].normal) << "never touched: " << before[i].normal;
      const double gained = specific_energy(one, radius) / energy - 1.0;
      gain.single = std::max(gain.single, gained);
      mean += gained / static_cast<double>(after[i].size());
    }
    gain.mean = std::max(gain.mean, mean);
  }
  return gain;
}

void check(const std::string& name, const std::string& quantity, double found, double tolerance,
           const std::string& reason) {
  verification::check({.group = "particles",
                       .name = name,
                       .quantity = quantity,
                       .unit = "",
                       .reference = "no gain of energy",
                       .origin = "second law",
                       .expected = 0.0,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = reason});
}

void check_all(const std::string& name, Partner partner, bool lever_is_radius) {
  check(name, "largest gain of a single impact, e = 0.7, t_e/10", gain_of(0.7, partner, lever_is_radius).single, 1e-13,
        "exact: round-off");
  const Gain elastic = gain_of(1.0, partner, lever_is_radius);
  check(name, "largest gain, mean over the phase of entry, e = 1, t_e/10", elastic.mean, 1e-4,
        "discretisation, third order");
  check(name, "largest gain of a single impact, e = 1, t_e/10", elastic.single, 6e-3,
        "discretisation: the phase of entry, at steep impacts, in normal motion only");
}

TEST(GrazingImpact, APairGainsNoEnergy) { check_all("energy at all angles, two particles", Partner::particle, true); }

TEST(GrazingImpact, AParticleOnTheSurfaceGainsNoEnergy) {
  check_all("energy at all angles, surface, lever to the touched point", Partner::surface, false);
  check_all("energy at all angles, surface, lever of a radius", Partner::surface, true);
}

}  // namespace
}  // namespace grainstep::dem
