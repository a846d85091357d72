#include "orchestrator/record/free_oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace grainstep::orchestrator {
namespace {

using Samples = std::span<const DeflectionSample>;

constexpr double still_to_come = 1e-3;       // of all impulse
constexpr double clear = 0.25, faint = 0.1;  // of the range
constexpr std::size_t fewest_samples = 8;    // of one swing

Samples after_the_load(Samples samples) {
  if (samples.empty()) return samples;
  const double enough = (1.0 - still_to_come) * samples.back().load;
  const auto over = std::find_if(samples.begin(), samples.end(),
                                 [enough](const DeflectionSample& sample) { return sample.load >= enough; });
  return samples.subspan(static_cast<std::size_t>(over - samples.begin()));
}

struct Range {
  double low, high;
  [[nodiscard]] double middle() const { return 0.5 * (low + high); }
  [[nodiscard]] double length() const { return high - low; }
};

Range range_of(Samples samples) {
  const auto [low, high] = std::minmax_element(
      samples.begin(), samples.end(),
      [](const DeflectionSample& a, const DeflectionSample& b) { return a.deflection < b.deflection; });
  return {low->deflection, high->deflection};
}

/// A passage through `level` between samples `before` and `before + 1`.
struct Passage {
  std::size_t before;
  double time;
};

double time_at(const DeflectionSample& a, const DeflectionSample& b, double level) {
  const double rise = b.deflection - a.deflection;
  return rise == 0.0 ? a.time : a.time + (level - a.deflection) / rise * (b.time - a.time);
}

/// Passages from as much as `margin` below the middle of the range to as much above, at the last sample below it; of
/// `sign` -1 the other way.
std::vector<Passage> passages(Samples samples, const Range& range, double margin, double sign) {
  std::vector<Passage> found;
  bool below = false;
  std::size_t last_below = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double height = sign * (samples[i].deflection - range.middle());
    if (height < -margin) below = true;
    if (below && height < 0.0) last_below = i;
    if (!below || height <= margin) continue;
    found.push_back({last_below, time_at(samples[last_below], samples[last_below + 1], range.middle())});
    below = false;
  }
  return found;
}

/// The last two passages of one direction, whichever comes later.
std::optional<std::pair<Passage, Passage>> last_pair(Samples samples, const Range& range, double margin) {
  std::optional<std::pair<Passage, Passage>> last;
  for (const double sign : {1.0, -1.0}) {
    const std::vector<Passage> all = passages(samples, range, margin, sign);
    if (all.size() < 2) continue;
    const Passage& end = all.back();
    if (!last || end.time > last->second.time) last = {all[all.size() - 2], end};
  }
  return last;
}

/// By trapezia, both ends at `level`.
Oscillation between(Samples samples, const std::pair<Passage, Passage>& ends, double level) {
  Oscillation out{.from = ends.first.time, .to = ends.second.time};
  Range range{level, level};
  double time = out.from;
  double above = 0.0;  // deflection less `level`
  double sum = 0.0;
  for (std::size_t i = ends.first.before + 1; i <= ends.second.before; ++i) {
    const double now = samples[i].deflection - level;
    sum += 0.5 * (above + now) * (samples[i].time - time);
    time = samples[i].time;
    above = now;
    range = {std::min(range.low, samples[i].deflection), std::max(range.high, samples[i].deflection)};
  }
  sum += 0.5 * above * (out.to - time);
  out.mean = level + sum / (out.to - out.from);
  out.spread = 0.5 * range.length();
  return out;
}

/// Drops what the structure does before its first turn: the first one after 95% of the way from the first sample to the
/// one that is farthest from it, for ripple may make a later turn the farthest.
Samples from_the_turn(Samples samples) {
  constexpr double most = 0.95;
  const auto way = [&](std::size_t i) { return std::abs(samples[i].deflection - samples[0].deflection); };
  double farthest = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) farthest = std::max(farthest, way(i));
  std::size_t turn = 0;
  while (way(turn) < most * farthest) ++turn;
  while (turn + 1 < samples.size() && way(turn + 1) > way(turn)) ++turn;
  return samples.subspan(turn);
}

/// The last swing in terms of the range of all samples, which it passes by `part` either side of the middle. A smaller
/// one after it is found in the range of what comes later.
std::optional<Oscillation> last_swing(Samples samples, double part) {
  std::optional<Oscillation> found;
  while (samples.size() >= fewest_samples) {
    const Range range = range_of(samples);
    const auto ends = last_pair(samples, range, part * range.length());
    if (!ends || ends->second.before - ends->first.before < fewest_samples) break;
    if (found && !(ends->second.time > found->to)) break;
    found = between(samples, *ends, range.middle());
    samples = samples.subspan((ends->first.before + ends->second.before) / 2);
  }
  return found;
}

}  // namespace

std::optional<Oscillation> last_free_oscillation(Samples samples) {
  samples = after_the_load(samples);
  while (samples.size() > fewest_samples) {
    for (const double part : {clear, faint}) {
      if (const auto found = last_swing(samples, part)) return found;
    }
    const Samples rest = from_the_turn(samples);
    if (rest.size() == samples.size()) break;
    samples = rest;
  }
  return std::nullopt;
}

}  // namespace grainstep::orchestrator
