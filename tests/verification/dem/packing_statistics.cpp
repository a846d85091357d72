// What a random packing must be: as dense as asked, free of overlaps, isotropic, of the pair correlation of random
// sequential addition, and another one for another seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "../../unit/dem-service/engine_rig.hpp"
#include "dem-service/slug/packing.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using surface::Vec2;
using verification::Comparison;

constexpr double section = std::numbers::pi / 4.0;  // of a disc of diameter 1

void check(const std::string& quantity, double expected, double found, double tolerance, const std::string& reason,
           const std::string& origin) {
  verification::check({.group = "particles",
                       .name = "random packing",
                       .quantity = quantity,
                       .unit = "",
                       .reference = "closed form",
                       .origin = origin,
                       .expected = expected,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = reason});
}

/// `count` discs of diameter 1 in a square of that solid fraction, sorted by x1.
struct Packing {
  double side;
  std::vector<Vec2> centres;
};

Packing pack(double fraction, std::uint64_t count, std::uint64_t seed) {
  Packing result{std::sqrt(static_cast<double>(count) * section / fraction), {}};
  const PackingBox box{{{0.0, 0.0}}, {{result.side, result.side}}};
  result.centres = pack_at_random(box, std::vector<double>(count, 1.0), seed);
  std::sort(result.centres.begin(), result.centres.end(), [](const Vec2& a, const Vec2& b) { return a[0] < b[0]; });
  return result;
}

constexpr double margin = 3.0;  // to the outline: walls order their neighbours

bool is_inside(const Packing& packing, const Vec2& p) {
  const auto within = [&](double x) { return x > margin && x < packing.side - margin; };
  return within(p[0]) && within(p[1]);
}

/// Calls action(way) with the way from every centre inside to every other one within `reach`.
template <class Action>
void for_neighbours(const Packing& packing, double reach, Action action) {
  const std::vector<Vec2>& all = packing.centres;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size() && all[j][0] - all[i][0] < reach; ++j) {
      const Vec2 way = all[j] - all[i];
      if (dot(way, way) >= reach * reach) continue;
      if (is_inside(packing, all[i])) action(way);
      if (is_inside(packing, all[j])) action(-way);
    }
  }
}

TEST(PackingStatistics, SolidFractionIsExactToOneParticle) {
  double worst = 0.0;
  for (const double fraction : {0.05, 0.1, 0.2, 0.3, 0.45}) {
    for (const double diameter : {1e-3, 0.7e-3}) {
      wire::Setup setup = rig::reference_setup();
      rig::slug_of(setup).set_relative_density(fraction);
      rig::slug_of(setup).mutable_particle()->set_diameter(diameter);
      const SlugModel model = rig::model_of(setup);
      rig::set_flat_surface(setup, 0.2, 60);
      const rig::ScriptedLink link = rig::run_slug(setup, rig::start_of(model.preferred_step, 1));
      const double area = 2.0 * model.half_width * model.height;
      const double wanted = fraction * area / (section * diameter * diameter);
      worst = verification::larger(worst, std::abs(link.snapshots.front().position_size() / 2 - wanted));
    }
  }
  check("largest difference from the number rho W H/(pi D^2/4), in particles", 0.0, worst, 0.5,
        "exact: the number is rounded", "definition of the solid fraction");
}

TEST(PackingStatistics, NoOverlap) {
  double closest = 2.0;
  for (const double fraction : {0.05, 0.2, 0.45, 0.52}) {
    for_neighbours(pack(fraction, 20000, 3), 1.5, [&](const Vec2& way) { closest = std::min(closest, norm(way)); });
  }
  check("deepest overlap of 80000 discs, solid fractions 0.05 to 0.52", 0.0, std::max(0.0, 1.0 - closest), 1e-15,
        "exact: places are refused by this very distance", "definition of overlap");
}

TEST(PackingStatistics, IsIsotropicAndUniform) {
  for (const double fraction : {0.2, 0.45}) {
    const Packing packing = pack(fraction, 20000, 1);
    double wave[2][3] = {};
    double pairs = 0.0;
    for_neighbours(packing, 1.5, [&](const Vec2& way) {
      const double angle = std::atan2(way[1], way[0]);
      for (int k = 0; k < 3; ++k) {
        wave[0][k] += std::cos(2.0 * (k + 1) * angle);
        wave[1][k] += std::sin(2.0 * (k + 1) * angle);
      }
      pairs += 1.0;
    });
    double worst = 0.0;
    for (int k = 0; k < 3; ++k) worst = verification::larger(worst, std::hypot(wave[0][k], wave[1][k]) / pairs);
    const std::string where = ", solid fraction " + std::to_string(fraction).substr(0, 4);
    check("largest mean of exp(i k theta) over neighbours within 1.5 D, k = 2, 4, 6" + where, 0.0, worst,
          4.0 / std::sqrt(pairs / 2.0), "statistics: four standard deviations of that many pairs", "isotropy");
    Vec2 mean;
    for (const Vec2& p : packing.centres) mean += p * (1.0 / (20000.0 * packing.side));
    check("distance of the mean place from the middle, over the side" + where, 0.0, norm(mean - Vec2{{0.5, 0.5}}),
          4.0 * std::sqrt(2.0 / 12.0 / 20000.0), "statistics: four standard deviations of independent places",
          "uniformity");
  }
}

/// Area common to two circles of radius 1 (around two disc centres), their centres r apart.
double shared_area(double r) { return 2.0 * std::acos(0.5 * r) - 0.5 * r * std::sqrt(4.0 - r * r); }

constexpr double shell = 0.1;
constexpr int shells = 15;  // from contact to 2.5 D

/// g(r) in shells from contact, mean of many packings.
std::vector<double> pair_correlation(double fraction, int seeds) {
  std::vector<double> count(shells, 0.0);
  double weight = 0.0;  // centres looked from, times their density
  for (int seed = 1; seed <= seeds; ++seed) {
    const Packing packing = pack(fraction, 20000, static_cast<std::uint64_t>(seed));
    const auto inside = static_cast<double>(std::count_if(packing.centres.begin(), packing.centres.end(),
                                                          [&](const Vec2& p) { return is_inside(packing, p); }));
    weight += inside * inside / std::pow(packing.side - 2.0 * margin, 2);
    for_neighbours(packing, 1.0 + shells * shell, [&](const Vec2& way) {
      count[std::min<std::size_t>(shells - 1, static_cast<std::size_t>((norm(way) - 1.0) / shell))] += 1.0;
    });
  }
  for (int s = 0; s < shells; ++s) {
    const double inner = 1.0 + s * shell;
    const double outer = inner + shell;
    count[static_cast<std::size_t>(s)] /= weight * std::numbers::pi * (outer * outer - inner * inner);
  }
  return count;
}

// A third disc k keeps others off; if it was placed before the later one of a pair, that pair is more likely by the
// share of k's forbidden area that both members share. Two orders in three are of that kind:
// g(r) = 1 + (2/3) n A(r) + O(n^2), n discs per D^2.
TEST(PackingStatistics, PairCorrelationOfRandomSequentialAddition) {
  constexpr double fraction = 0.05;
  const double density = fraction / section;
  const std::vector<double> found = pair_correlation(fraction, 60);
  verification::Series measured{"found", {}, {}, verification::Series::Mark::points};
  verification::Series expected{"1 + (2/3) n A(r)", {}, {}, verification::Series::Mark::line};
  double near = 0.0;
  double near_expected = 0.0;
  double area = 0.0;
  for (int s = 0; s < shells; ++s) {
    const double r = 1.0 + (s + 0.5) * shell;
    const double g = 1.0 + (r < 2.0 ? 2.0 / 3.0 * density * shared_area(r) : 0.0);
    measured.x.push_back(r);
    measured.y.push_back(found[static_cast<std::size_t>(s)]);
    expected.x.push_back(r);
    expected.y.push_back(g);
    if (s >= 5) continue;
    near += r * found[static_cast<std::size_t>(s)];
    near_expected += r * g;
    area += r;
  }
  check("mean g(r) from D to 1.5 D, solid fraction 0.05, 1.2 million discs", near_expected / area, near / area, 8e-3,
        "statistics, three standard deviations; model: second order in the density",
        "1 + (2/3) n A(r), expansion in "
        "the density n for sequential addition, A the area that two exclusion circles share");
  verification::curve({.group = "particles",
                       .name = "random packing",
                       .title = "pair correlation, solid fraction 0.05",
                       .x_label = "r / D",
                       .y_label = "g(r)",
                       .series = {measured, expected}});
}

TEST(PackingStatistics, SeedsAreIndependent) {
  constexpr int cells = 20;
  constexpr int seeds = 10;
  std::vector<std::vector<double>> counts(seeds, std::vector<double>(cells * cells, 0.0));
  for (int seed = 0; seed < seeds; ++seed) {
    const Packing packing = pack(0.2, 20000, static_cast<std::uint64_t>(seed + 1));
    for (const Vec2& p : packing.centres) {
      const int column = static_cast<int>((p[0] - 0.5) / (packing.side - 1.0) * cells);
      const int row = static_cast<int>((p[1] - 0.5) / (packing.side - 1.0) * cells);
      counts[static_cast<std::size_t>(seed)][static_cast<std::size_t>(row * cells + column)] += 1.0;
    }
  }
  const double mean = 20000.0 / (cells * cells);
  const auto covariance = [&](int a, int b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < cells * cells; ++i) {
      sum += (counts[static_cast<std::size_t>(a)][i] - mean) * (counts[static_cast<std::size_t>(b)][i] - mean);
    }
    return sum;
  };
  double correlation = 0.0;
  int pairs = 0;
  for (int a = 0; a < seeds; ++a) {
    for (int b = 0; b < a; ++b, ++pairs) {
      correlation += covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
    }
  }
  check("mean correlation of the numbers in 400 cells between ten seeds", 0.0, correlation / pairs,
        4.0 / std::sqrt(1.0 * pairs * cells * cells), "statistics: four standard deviations", "independence");
}

}  // namespace
}  // namespace grainstep::dem
