// A slug of spheres in its slice: what it weighs per area along the radius, and how full it is beside the planes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "../../unit/dem-service/slice_rig.hpp"
#include "contact/moving_surface.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using rig::degree;
using surface::Vec3;
using verification::Series;

constexpr int seeds = 40;
constexpr double diameter = 2e-3;
constexpr double slug_radius = 0.1;
constexpr double slug_height = 0.15;
constexpr double fraction = 0.2;
constexpr double slice = 10.0 * degree;
constexpr double volume_of_one = std::numbers::pi / 6.0 * diameter * diameter * diameter;

std::vector<Vec3> centres_of(std::uint64_t seed) {
  wire::Setup setup = rig::slice_setup(slice);
  scene::Slug& slug = rig::slug_of(setup);
  slug.set_half_width(slug_radius);
  slug.set_height(slug_height);
  slug.set_relative_density(fraction);
  slug.set_seed(seed);
  slug.mutable_particle()->set_diameter(diameter);
  rig::set_rings(setup, 0.5, 10);
  std::vector<Vec3> centres;
  for (const PlacedParticle& p :
       lay_out(rig::model_of(setup), contact::MovingSurface(setup.impactor().surface()).now())) {
    centres.push_back(p.position);
  }
  return centres;
}

void check(const std::string& quantity, double expected, double found, double tolerance, const std::string& reason) {
  verification::check({.group = "particles",
                       .name = "slug of spheres in a slice of 10 degrees, D = 2 mm",
                       .quantity = quantity,
                       .unit = "",
                       .reference = "uniform slug",
                       .origin = "definition of the solid fraction",
                       .expected = expected,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = reason});
}

/// Solid area of a plane parallel to theta = 0 or theta = slice at `distance` from it, over its area; r in 60 to 98 mm.
double solid_beside_planes(const std::vector<Vec3>& centres, double distance) {
  constexpr double from = 0.06;
  constexpr double to = 0.098;
  double solid = 0.0;
  for (const Vec3& p : centres) {
    for (const double off : {p[2], std::sin(slice) * p[0] - std::cos(slice) * p[2]}) {
      const double r = std::sqrt(p[0] * p[0] + p[2] * p[2] - off * off);  // along the plane
      const double cut = 0.25 * diameter * diameter - (off - distance) * (off - distance);
      if (r > from && r < to && cut > 0.0) solid += std::numbers::pi * cut;
    }
  }
  return solid / (2.0 * (to - from) * slug_height);
}

TEST(SlicePacking, IsUniformAlongTheRadiusAndBesideThePlanes) {
  Series beside{"mean of 40 seeds", {}, {}, Series::Mark::points};
  Series along{"mean of 40 seeds", {}, {}, Series::Mark::points};
  for (double x = 0.0; x < 2.6; x += 0.1) beside.x.push_back(x);
  beside.y.assign(beside.x.size(), 0.0);
  constexpr double ring = 2.5e-3;
  for (double r = 0.5 * ring; r < slug_radius; r += ring) along.x.push_back(r / slug_radius);
  along.y.assign(along.x.size(), 0.0);
  double off = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const std::vector<Vec3> centres = centres_of(static_cast<std::uint64_t>(seed));
    const double wanted = fraction * 0.5 * slice * slug_radius * slug_radius * slug_height / volume_of_one;
    off = verification::larger(off, std::abs(static_cast<double>(centres.size()) - wanted));
    for (std::size_t i = 0; i < beside.x.size(); ++i) {
      beside.y[i] += solid_beside_planes(centres, beside.x[i] * diameter) / seeds;
    }
    for (const Vec3& p : centres) {
      const auto i = static_cast<std::size_t>(std::hypot(p[0], p[2]) / ring);
      const double room = slice * along.x[i] * slug_radius * ring * slug_height;
      along.y[i] += volume_of_one / room / seeds;
    }
  }
  check("largest difference from the number rho_bar (phi/2) a^2 H/(pi D^3/6), in spheres", 0.0, off, 0.5,
        "exact: the number is rounded");

  const double empty = 0.5 * diameter / std::sin(0.5 * slice);
  double uniform = 0.0;
  double rings = 0.0;
  for (std::size_t i = 0; i < along.x.size(); ++i) {
    const double r = along.x[i] * slug_radius;
    if (r < empty + ring || r > slug_radius - 0.5 * diameter - ring) continue;
    uniform += along.y[i];
    rings += 1.0;
  }
  uniform /= rings;
  double worst = 0.0;
  for (std::size_t i = 0; i < along.x.size(); ++i) {
    const double r = along.x[i] * slug_radius;
    if (r < empty + ring || r > slug_radius - 0.5 * diameter - ring) continue;
    worst = verification::larger(worst, std::abs(along.y[i] / uniform - 1.0));
  }
  check("mean solid fraction over the rings that can hold centres",
        fraction * slug_radius * slug_radius / (std::pow(slug_radius - 0.5 * diameter, 2) - empty * empty), uniform,
        2e-3,
        "exact but for rings cut by the limits: centres keep one radius from the rim and r > R/sin(phi/2) = 11.5 R");
  check("largest deviation of a ring of 2.5 mm from that mean", 0.0, worst, 0.02,
        "exact by quota, but for the binning: ring edges between two quotas");

  const auto mean = [&](double from, double to) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < beside.x.size(); ++i) {
      if (beside.x[i] < from - 0.01 || beside.x[i] > to + 0.01) continue;
      sum += beside.y[i];
      count += 1.0;
    }
    return sum / count;
  };
  check("solid fraction 1 to 1.5 D from the planes over that 2 to 2.5 D from them", 1.0,
        mean(1.0, 1.5) / mean(2.0, 2.5), 0.04,
        "model: a place beside a plane has neighbours on one side only and is refused less often; fades with the "
        "distance");
  check("solid fraction 1.5 to 2 D from the planes over that 2 to 2.5 D from them", 1.0,
        mean(1.5, 2.0) / mean(2.0, 2.5), 0.015, "model: likewise, it swings and fades");
  verification::curve({.group = "particles",
                       .name = "slug of spheres in a slice of 10 degrees, D = 2 mm",
                       .title = "beside the planes, r = 60 to 98 mm",
                       .x_label = "distance from the plane / D",
                       .y_label = "solid fraction",
                       .series = {beside}});
  verification::curve({.group = "particles",
                       .name = "slug of spheres in a slice of 10 degrees, D = 2 mm",
                       .title = "along the radius",
                       .x_label = "r / a",
                       .y_label = "solid fraction, centres per ring",
                       .series = {along, {"asked for", {0.0, 1.0}, {fraction, fraction}, Series::Mark::line}}});
}

}  // namespace
}  // namespace grainstep::dem
