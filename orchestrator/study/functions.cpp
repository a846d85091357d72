#include "orchestrator/study/functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.hpp"

namespace grainstep::study {
namespace {

using Arguments = std::vector<Values>;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

template <double (*Operation)(double)>
Values each(const Arguments& a) {
  Values out = a[0];
  for (double& value : out) value = Operation(value);
  return out;
}

double mean_of(const Values& v) {
  return v.empty() ? nothing : std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

/// Of a sample: n - 1.
double deviation_of(const Values& v) {
  if (v.size() < 2) return nothing;
  const double mean = mean_of(v);
  const double sum =
      std::accumulate(v.begin(), v.end(), 0.0, [mean](double s, double x) { return s + (x - mean) * (x - mean); });
  return std::sqrt(sum / static_cast<double>(v.size() - 1));
}

/// NaN among them is not overlooked.
template <bool largest>
double extreme_of(const Values& v) {
  if (v.empty() || std::any_of(v.begin(), v.end(), [](double x) { return std::isnan(x); })) return nothing;
  return largest ? *std::max_element(v.begin(), v.end()) : *std::min_element(v.begin(), v.end());
}

void require_pairs(const Values& y, const Values& x) {
  if (x.size() != y.size()) {
    throw InputError("lists of " + std::to_string(y.size()) + " and " + std::to_string(x.size()) +
                     " values; both must be of the same length");
  }
}

/// Of the least-squares line.
double slope_of(const Values& y, const Values& x) {
  require_pairs(y, x);
  const double mean_x = mean_of(x);
  const double mean_y = mean_of(y);
  double xy = 0.0;
  double xx = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    xx += (x[i] - mean_x) * (x[i] - mean_x);
  }
  return x.size() < 2 ? nothing : xy / xx;
}

double order_of(const Values& y, const Values& x) {
  const Arguments both = {y, x};
  Arguments logs;
  for (const Values& values : both) {
    logs.push_back(values);
    for (double& value : logs.back()) value = std::log(std::abs(value));
  }
  return slope_of(logs[0], logs[1]);
}

double interpolated(const Values& y, const Values& x, double at) {
  const auto above = std::lower_bound(x.begin(), x.end(), at);
  if (x.empty() || above == x.end() || at < x.front()) return nothing;
  if (above == x.begin()) return y.front();
  const auto i = static_cast<std::size_t>(above - x.begin());
  return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

/// At every one of a list: brings histories with rows of their own to common times.
Values interpolated_at(const Arguments& a) {
  require_pairs(a[0], a[1]);
  Values out;
  for (const double at : a[2]) out.push_back(interpolated(a[0], a[1], at));
  return out;
}

/// The first x at which y is not below `level`; NaN where it never comes so far.
double reached(const Values& y, const Values& x, double level) {
  require_pairs(y, x);
  const auto above = std::find_if(y.begin(), y.end(), [level](double value) { return value >= level; });
  if (above == y.end()) return nothing;
  if (above == y.begin()) return x.front();
  const auto i = static_cast<std::size_t>(above - y.begin());
  return x[i - 1] + (x[i] - x[i - 1]) * (level - y[i - 1]) / (y[i] - y[i - 1]);
}

constexpr double most_grid_points = 1e6;

/// Both ends are exact.
Values grid(double from, double to, double count) {
  if (!(count >= 2.0 && count <= most_grid_points)) throw InputError("grid: expected 2 to 1000000 values");
  Values out;
  const auto last = static_cast<std::size_t>(count) - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(last);
    out.push_back((1.0 - part) * from + part * to);
  }
  return out;
}

/// The row of a table with one row per interval that begins at times[i], in which `at` lies.
Values row_of(const Values& table, const Values& times, double at) {
  const auto after = std::upper_bound(times.begin(), times.end(), at);
  if (after == times.begin() || table.size() % times.size() != 0) return {};
  const std::size_t columns = table.size() / times.size();
  const auto begin = table.begin() + static_cast<std::ptrdiff_t>(columns) * (after - times.begin() - 1);
  return {begin, begin + static_cast<std::ptrdiff_t>(columns)};
}

/// Of every column of a table whose rows are means over intervals.
Values over_time(const Values& table, const Values& from, const Values& to) {
  require_pairs(to, from);
  if (from.empty() || table.size() % from.size() != 0) throw InputError("over_time: expected one row per interval");
  const std::size_t columns = table.size() / from.size();
  Values out(columns);
  for (std::size_t i = 0; i < table.size(); ++i) out[i % columns] += table[i] * (to[i / columns] - from[i / columns]);
  return out;
}

Values differences(const Arguments& a) {
  Values out;
  for (std::size_t i = 1; i < a[0].size(); ++i) out.push_back(a[0][i] - a[0][i - 1]);
  return out;
}

Values middles(const Arguments& a) {
  Values out;
  for (std::size_t i = 1; i < a[0].size(); ++i) out.push_back(0.5 * (a[0][i] + a[0][i - 1]));
  return out;
}

double single(const Values& value) {
  if (value.size() != 1) throw InputError("expected one number as argument, found a list");
  return value[0];
}

}  // namespace

const std::vector<Function>& functions() {
  static const std::vector<Function> all = {
      {"abs", "abs(x)", 1, each<std::abs>},
      {"sqrt", "sqrt(x)", 1, each<std::sqrt>},
      {"log", "log(x), natural", 1, each<std::log>},
      {"log10", "log10(x)", 1, each<std::log10>},
      {"exp", "exp(x)", 1, each<std::exp>},
      {"mean", "mean(list)", 1, [](const Arguments& a) { return Values{mean_of(a[0])}; }},
      {"deviation", "deviation(list), standard, of a sample", 1,
       [](const Arguments& a) { return Values{deviation_of(a[0])}; }},
      {"min", "min(list)", 1, [](const Arguments& a) { return Values{extreme_of<false>(a[0])}; }},
      {"max", "max(list)", 1, [](const Arguments& a) { return Values{extreme_of<true>(a[0])}; }},
      {"first", "first(list)", 1, [](const Arguments& a) { return Values{a[0].empty() ? nothing : a[0].front()}; }},
      {"last", "last(list)", 1, [](const Arguments& a) { return Values{a[0].empty() ? nothing : a[0].back()}; }},
      {"count", "count(list)", 1, [](const Arguments& a) { return Values{static_cast<double>(a[0].size())}; }},
      {"differences", "differences(list), of neighbours", 1, differences},
      {"middles", "middles(list), of neighbours", 1, middles},
      {"grid", "grid(from, to, count), equally spaced", 3,
       [](const Arguments& a) { return grid(single(a[0]), single(a[1]), single(a[2])); }},
      {"slope", "slope(y, x), of the least-squares line", 2,
       [](const Arguments& a) { return Values{slope_of(a[0], a[1])}; }},
      {"order", "order(y, x), slope of log|y| over log|x|", 2,
       [](const Arguments& a) { return Values{order_of(a[0], a[1])}; }},
      {"interpolate", "interpolate(y, x, at), x increasing; `at` may be a list", 3, interpolated_at},
      {"reached", "reached(y, x, level), the first x at which y comes so far", 3,
       [](const Arguments& a) { return Values{reached(a[0], a[1], single(a[2]))}; }},
      {"over_time", "over_time(table, from, to), the integral of every column", 3,
       [](const Arguments& a) { return over_time(a[0], a[1], a[2]); }},
      {"row", "row(table, times, at), e.g. row(profiles.pressure, profiles.from, 0.1e-3)", 3,
       [](const Arguments& a) { return row_of(a[0], a[1], single(a[2])); }}};
  return all;
}

const Function* find_function(const std::string& name) {
  const auto found =
      std::find_if(functions().begin(), functions().end(), [&](const Function& f) { return f.name == name; });
  return found == functions().end() ? nullptr : &*found;
}

Values combine(const Values& left, const Values& right, double (*operation)(double, double)) {
  if (left.size() != right.size() && left.size() != 1 && right.size() != 1) require_pairs(left, right);
  const bool none = left.empty() || right.empty();
  Values out(none ? 0 : std::max(left.size(), right.size()));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = operation(left[left.size() == 1 ? 0 : i], right[right.size() == 1 ? 0 : i]);
  }
  return out;
}

}  // namespace grainstep::study
