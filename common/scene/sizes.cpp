#include "scene/sizes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "base/number_text.hpp"

namespace grainstep::scene {
namespace {

/// Sizes of equal weight between `from` and `to`, as the scene counts them: not yet scaled to their mean.
struct Part {
  double from, to, weight;
  [[nodiscard]] double middle() const { return 0.5 * (from + to); }
};

/// A density in parts of equal width, by its values in their middles: the mean of a bell is exact to 1e-7.
std::vector<Part> in_parts(double from, double to, const std::function<double(double)>& density) {
  constexpr int parts = 2000;
  std::vector<Part> all;
  all.reserve(parts);
  const auto edge = [&](int k) { return from + (to - from) * k / parts; };
  for (int k = 0; k < parts; ++k) {
    all.push_back({edge(k), edge(k + 1), 0.0});
    all.back().weight = density(all.back().middle());
  }
  return all;
}

double bell(double deviations) { return std::exp(-0.5 * deviations * deviations); }

std::vector<Part> parts_of(const SizeDistribution& sizes) {
  switch (sizes.shape_case()) {
    case SizeDistribution::kUniform:  // of equal density by number or by mass, which are not the same
      return in_parts(1.0 - sizes.uniform().width(), 1.0 + sizes.uniform().width(), [](double) { return 1.0; });
    case SizeDistribution::kNormal: {
      const double deviation = sizes.normal().deviation();
      const double reach = deviation * sizes.normal().cut();
      return in_parts(1.0 - reach, 1.0 + reach, [=](double d) { return bell((d - 1.0) / deviation); });
    }
    case SizeDistribution::kLognormal: {
      const double deviation = sizes.lognormal().deviation();
      const double reach = std::exp(deviation * sizes.lognormal().cut());
      return in_parts(1.0 / reach, reach, [=](double d) { return bell(std::log(d) / deviation) / d; });
    }
    case SizeDistribution::kBidisperse: {
      const double ratio = sizes.bidisperse().ratio();
      return {{1.0, 1.0, 1.0 - sizes.bidisperse().large()}, {ratio, ratio, sizes.bidisperse().large()}};
    }
    case SizeDistribution::kTabulated: {
      std::vector<Part> all;
      for (int i = 0; i < sizes.tabulated().size_size(); ++i) {
        all.push_back({sizes.tabulated().size(i), sizes.tabulated().size(i), sizes.tabulated().fraction(i)});
      }
      return all;
    }
    case SizeDistribution::SHAPE_NOT_SET:
      break;
  }
  return {{1.0, 1.0, 1.0}};
}

}  // namespace

Sizes::Sizes(const Slug& slug, int dimension) {
  if (!slug.has_size_distribution()) return;
  classes_.clear();
  const SizeDistribution& sizes = slug.size_distribution();
  const std::vector<Part> parts = parts_of(sizes);
  double weight = 0.0;
  double moment = 0.0;
  for (const Part& part : parts) {
    weight += part.weight;
    moment += part.weight * part.middle();
  }
  const double mean = moment / weight;
  double number = 0.0;
  for (const Part& part : parts) {
    number += sizes.by() == SizeDistribution::BY_MASS ? part.weight / std::pow(part.middle(), dimension) : part.weight;
    classes_.push_back({part.from / mean, part.to / mean, number});
  }
  for (Class& one : classes_) one.share /= number;
}

double Sizes::mean_of_power(int k) const {
  double sum = 0.0;
  double below = 0.0;
  for (const Class& one : classes_) {
    sum += (one.share - below) * std::pow(0.5 * (one.from + one.to), k);
    below = one.share;
  }
  return sum;
}

double Sizes::not_exceeded_by(double share) const {
  const auto at = std::min(std::ranges::lower_bound(classes_, share, {}, &Class::share), classes_.end() - 1);
  const double below = at == classes_.begin() ? 0.0 : std::prev(at)->share;
  const double part = std::clamp((share - below) / (at->share - below), 0.0, 1.0);
  return at->from + part * (at->to - at->from);
}

std::vector<double> Sizes::descending(std::uint64_t count) const {
  std::vector<double> all(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    all[count - 1 - i] = not_exceeded_by((static_cast<double>(i) + 0.5) / static_cast<double>(count));
  }
  return all;
}

namespace {

std::vector<SizeProblem> table_problems(const TabulatedSizes& table) {
  if (table.size_size() != table.fraction_size()) {
    return {{"tabulated.fraction", std::to_string(table.fraction_size()) + " fractions for " +
                                       std::to_string(table.size_size()) + " sizes; expected one for each"}};
  }
  std::vector<SizeProblem> found;
  for (int k = 0; k + 1 < table.size_size(); ++k) {
    if (table.size(k) < table.size(k + 1)) continue;
    found.push_back({"tabulated.size." + std::to_string(k + 1), rounded_text(table.size(k + 1)) + " follows " +
                                                                    rounded_text(table.size(k)) +
                                                                    "; sizes must increase strictly"});
  }
  constexpr double decimals = 1e-6;  // as people write thirds
  const double sum = std::accumulate(table.fraction().begin(), table.fraction().end(), 0.0);
  if (std::abs(sum - 1.0) > decimals) {
    found.push_back({"tabulated.fraction", "the fractions sum to " + rounded_text(sum) + "; expected 1"});
  }
  return found;
}

/// The key that widens a shape.
std::string width_key(const SizeDistribution& sizes) {
  switch (sizes.shape_case()) {
    case SizeDistribution::kUniform:
      return "uniform.width";
    case SizeDistribution::kNormal:
      return "normal.deviation";
    case SizeDistribution::kLognormal:
      return "lognormal.deviation";
    case SizeDistribution::kBidisperse:
      return "bidisperse.ratio";
    default:
      return "tabulated.size";
  }
}

}  // namespace

std::vector<SizeProblem> size_problems(const SizeDistribution& sizes) {
  if (sizes.shape_case() == SizeDistribution::SHAPE_NOT_SET) {
    return {{"", "needs a shape: one of uniform, normal, lognormal, bidisperse, tabulated"}};
  }
  if (sizes.has_tabulated()) {
    const std::vector<SizeProblem> found = table_problems(sizes.tabulated());
    if (!found.empty()) return found;
  }
  const std::vector<Part> parts = parts_of(sizes);
  const double smallest = parts.front().from;
  const double largest = parts.back().to;
  if (sizes.has_normal() && !(smallest > 0.0)) {
    return {{width_key(sizes), "with a cut at " + rounded_text(sizes.normal().cut()) +
                                   " deviations the smallest particle has no size left; expected less than " +
                                   rounded_text(1.0 / sizes.normal().cut())}};
  }
  if (!(largest <= widest_range_of_sizes * smallest)) {
    return {{width_key(sizes), "the largest particles are " + rounded_text(largest / smallest) +
                                   " times as wide as the smallest; expected at most " +
                                   rounded_text(widest_range_of_sizes) + " times: take a narrower distribution"}};
  }
  return {};
}

}  // namespace grainstep::scene
