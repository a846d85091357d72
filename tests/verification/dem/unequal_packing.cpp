// A packing of unequal particles: the sizes that were asked for, as dense as asked, without overlap, isotropic, and
// another one for another seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "../../unit/dem-service/slice_rig.hpp"
#include "contact/moving_surface.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using surface::Vec3;
using Slug = scene::Slug;

struct Case {
  std::string name;
  std::function<void(scene::SizeDistribution&)> set;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"uniform, width 0.3", [](auto& s) { s.mutable_uniform()->set_width(0.3); }},
      {"uniform by mass, width 0.6",
       [](auto& s) {
         s.set_by(scene::SizeDistribution::BY_MASS);
         s.mutable_uniform()->set_width(0.6);
       }},
      {"normal, deviation 0.2, cut at 2",
       [](auto& s) {
         s.mutable_normal()->set_deviation(0.2);
         s.mutable_normal()->set_cut(2.0);
       }},
      {"lognormal by mass, deviation 0.4, cut at 2",
       [](auto& s) {
         s.set_by(scene::SizeDistribution::BY_MASS);
         s.mutable_lognormal()->set_deviation(0.4);
         s.mutable_lognormal()->set_cut(2.0);
       }},
      {"bidisperse by mass, ratio 4, half and half",
       [](auto& s) {
         s.set_by(scene::SizeDistribution::BY_MASS);
         s.mutable_bidisperse()->set_ratio(4.0);
         s.mutable_bidisperse()->set_large(0.5);
       }},
  };
  return all;
}

wire::Setup setup_of(const Case& one, bool spheres, double fraction, std::uint64_t seed = 1) {
  wire::Setup setup = spheres ? rig::slice_setup() : rig::reference_setup();
  Slug& slug = rig::slug_of(setup);
  slug.set_half_width(spheres ? 0.025 : 0.04);
  slug.set_height(spheres ? 0.02 : 0.08);
  slug.set_relative_density(fraction);
  slug.set_seed(seed);
  one.set(*slug.mutable_size_distribution());
  spheres ? rig::set_rings(setup, 0.2, 20) : rig::set_flat_surface(setup, 0.2, 20);
  return setup;
}

std::vector<PlacedParticle> packed(const wire::Setup& setup) {
  return lay_out(rig::model_of(setup), contact::MovingSurface(setup.impactor().surface()).now());
}

void check(const std::string& quantity, double expected, double found, double tolerance, const std::string& reason) {
  verification::check({.group = "particles",
                       .name = "random packing of unequal particles",
                       .quantity = quantity,
                       .unit = "",
                       .reference = "definition",
                       .origin = "the scene's size_distribution and relative_density",
                       .expected = expected,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = reason});
}

/// Share of all particles, or of their mass, up to a size, as the scene's keys define it (sizes over the mean D).
double asked(const Case& one, double size) {
  const auto normal = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  const auto cut = [&](double z) {
    return (normal(std::clamp(z, -2.0, 2.0)) - normal(-2.0)) / (1.0 - 2.0 * normal(-2.0));
  };
  scene::SizeDistribution s;
  one.set(s);
  if (s.has_uniform()) return std::clamp((size - 1.0 + s.uniform().width()) / (2.0 * s.uniform().width()), 0.0, 1.0);
  if (s.has_normal()) return cut((size - 1.0) / s.normal().deviation());
  if (s.has_lognormal()) {  // its mean: exp(s^2/2) times what the cut leaves of the shifted bell
    const double d = s.lognormal().deviation();
    const double mean = std::exp(0.5 * d * d) * (normal(2.0 - d) - normal(-2.0 - d)) / (1.0 - 2.0 * normal(-2.0));
    return cut(std::log(size * mean) / d);
  }
  return size < 1.0 ? 1.0 - s.bidisperse().large() : 1.0;  // the mean lies between both
}

/// Largest difference of the found distribution from the asked one, in shares.
double distance(const Case& one, const std::vector<PlacedParticle>& particles, double mean, int dimension) {
  scene::SizeDistribution s;
  one.set(s);
  const bool mass = s.by() == scene::SizeDistribution::BY_MASS;
  std::vector<double> sizes;
  for (const PlacedParticle& p : particles) sizes.push_back(p.diameter / mean);
  std::sort(sizes.begin(), sizes.end());
  const auto weight = [&](double size) { return mass ? std::pow(size, dimension) : 1.0; };
  double all = 0.0;
  for (const double size : sizes) all += weight(size);
  double sum = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sum += weight(sizes[i]);
    const bool last = i + 1 == sizes.size() || sizes[i + 1] > sizes[i] * (1.0 + 1e-9);
    if (last) worst = verification::larger(worst, std::abs(sum / all - asked(one, sizes[i] * (1.0 + 1e-12))));
  }
  return worst;
}

TEST(UnequalPacking, HasTheSizesAskedFor) {
  for (const bool spheres : {false, true}) {
    for (const Case& one : cases()) {
      const wire::Setup setup = setup_of(one, spheres, 0.2);
      const auto particles = packed(setup);
      const double found = distance(one, particles, rig::model_of(setup).diameter, spheres ? 3 : 2);
      // The heaviest particle's share: one by mass may be several by number.
      const SlugModel model = rig::model_of(setup);
      const double grain = std::pow(model.largest(), spheres ? 3 : 2) /
                           (std::pow(model.diameter, spheres ? 3 : 2) * model.sizes.mean_of_power(spheres ? 3 : 2));
      check(
          "largest difference of the share below a size, " + std::string(spheres ? "spheres, " : "discs, ") + one.name,
          0.0, found, grain / static_cast<double>(particles.size()), "exact to one of the largest particles");
    }
  }
}

TEST(UnequalPacking, IsAsDenseAsAskedAndFreeOfOverlap) {
  double off = 0.0;
  double deepest = 0.0;
  double outside = 0.0;
  for (const bool spheres : {false, true}) {
    for (const Case& one : cases()) {
      for (const double fraction : {0.1, spheres ? 0.3 : 0.45}) {
        const wire::Setup setup = setup_of(one, spheres, fraction);
        const SlugModel model = rig::model_of(setup);
        const auto particles = packed(setup);
        double solid = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
          const PlacedParticle& p = particles[i];
          solid += spheres ? std::numbers::pi / 6.0 * std::pow(p.diameter, 3)
                           : std::numbers::pi / 4.0 * std::pow(p.diameter, 2);
          const double across = spheres ? std::hypot(p.position[0], p.position[2]) : std::abs(p.position[0]);
          outside = verification::larger(outside, (across + 0.5 * p.diameter) / model.half_width - 1.0);
          if (spheres) outside = verification::larger(outside, (0.5 * p.diameter - p.position[2]) / model.half_width);
          for (std::size_t j = 0; j < i; ++j) {
            const double reach = 0.5 * (p.diameter + particles[j].diameter);
            deepest = verification::larger(deepest, 1.0 - norm(p.position - particles[j].position) / reach);
          }
        }
        const double room = spheres ? 0.5 * model.slice * model.half_width * model.half_width * model.height
                                    : 2.0 * model.half_width * model.height;
        off = verification::larger(off, std::abs(solid / (fraction * room) - 1.0));
      }
    }
  }
  check("largest difference of the solid area or volume from rho_bar times the slug's, over it", 0.0, off, 1e-11,
        "exact: round-off of a sum over some thousand particles");
  check("deepest overlap of a pair over the sum of its radii", 0.0, deepest, 1e-12, "exact: round-off of the places");
  check("farthest that a particle stands out of the slug, over its half width", 0.0, outside, 1e-12,
        "exact: round-off");
}

/// Means over the plane's discs of D^2 cos(k theta) of near neighbours, and correlation of two seeds' cells.
TEST(UnequalPacking, IsIsotropicAndSeedsAreIndependent) {
  constexpr int cells = 12;
  constexpr int seeds = 6;
  std::vector<std::vector<double>> mass(seeds, std::vector<double>(cells * cells, 0.0));
  double wave[2] = {};
  double pairs = 0.0;
  bool same_sizes = true;
  std::vector<double> first_sizes;
  for (int seed = 0; seed < seeds; ++seed) {
    const wire::Setup setup = setup_of(cases()[0], false, 0.3, static_cast<std::uint64_t>(seed + 1));
    const SlugModel model = rig::model_of(setup);
    const auto particles = packed(setup);
    std::vector<double> sizes;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const PlacedParticle& p = particles[i];
      sizes.push_back(p.diameter);
      const auto cell = [&](double part) { return std::clamp(static_cast<int>(part * cells), 0, cells - 1); };
      const int column = cell((p.position[0] + model.half_width) / (2.0 * model.half_width));
      const int row = cell(p.position[1] / model.height);
      mass[static_cast<std::size_t>(seed)][static_cast<std::size_t>(row * cells + column)] += p.diameter * p.diameter;
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3 way = p.position - particles[j].position;
        if (norm(way) > 0.75 * (p.diameter + particles[j].diameter)) continue;
        const double angle = std::atan2(way[1], way[0]);
        wave[0] += std::cos(2.0 * angle);
        wave[1] += std::sin(2.0 * angle);
        pairs += 1.0;
      }
    }
    if (seed == 0) first_sizes = sizes;
    same_sizes = same_sizes && sizes == first_sizes;
  }
  EXPECT_TRUE(same_sizes) << "every seed has the same sizes";
  check("mean of exp(2 i theta) over near neighbours", 0.0, std::hypot(wave[0], wave[1]) / pairs,
        4.0 / std::sqrt(pairs), "statistics: four standard deviations of that many pairs, and the outline's rows");
  // The rim's cells hold less in every seed: only those inside are compared.
  std::vector<std::vector<double>> inner(seeds);
  for (std::size_t s = 0; s < seeds; ++s) {
    double mean = 0.0;
    for (int i = 0; i < cells * cells; ++i) {
      if (std::min({i / cells, i % cells, cells - 1 - i / cells, cells - 1 - i % cells}) == 0) continue;
      inner[s].push_back(mass[s][static_cast<std::size_t>(i)]);
      mean += inner[s].back();
    }
    for (double& m : inner[s]) m -= mean / static_cast<double>(inner[s].size());
  }
  const auto covariance = [&](int a, int b) {
    const auto& one = inner[static_cast<std::size_t>(a)];
    return std::inner_product(one.begin(), one.end(), inner[static_cast<std::size_t>(b)].begin(), 0.0);
  };
  double correlation = 0.0;
  int count = 0;
  for (int a = 0; a < seeds; ++a) {
    for (int b = 0; b < a; ++b, ++count) {
      correlation += covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
    }
  }
  check("mean correlation of the mass in 100 cells between six seeds", 0.0, correlation / count,
        4.0 / std::sqrt(1.0 * count * (cells - 2) * (cells - 2)), "statistics: four standard deviations");
}

}  // namespace
}  // namespace grainstep::dem
