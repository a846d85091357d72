#include "replay/load_history.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.hpp"
#include "base/number_text.hpp"

namespace grainstep::replay {
namespace {

constexpr double beside = 1e-6;     // of the surface's size: round-off of coordinates, and no more
constexpr double rest = 0.05;       // of the record: as long without load, and the load is over
constexpr double round_off = 1e-9;  // of a time

template <typename Repeated>
bool equal(const Repeated& a, const Repeated& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

bool same(const wire::Surface& a, const wire::Surface& b) {
  return equal(a.position(), b.position()) && equal(a.facet(), b.facet());
}

surface::Vec2 node(const wire::Surface& surface, int index) {
  return {surface.position(2 * index), surface.position(2 * index + 1)};
}

surface::Polyline polyline_of(const wire::Surface& surface) {
  std::vector<surface::Vec2> nodes;
  nodes.reserve(static_cast<std::size_t>(surface.position_size() / 2));
  for (int i = 0; i < surface.position_size() / 2; ++i) nodes.push_back(node(surface, i));
  std::vector<surface::Polyline::Segment> segments;
  for (int i = 0; i + 1 < surface.facet_size(); i += 2) segments.push_back({surface.facet(i), surface.facet(i + 1)});
  return {std::move(nodes), std::move(segments)};
}

}  // namespace

LoadHistory::LoadHistory(Recording& recording, const wire::Surface& surface, const std::string& key)
    : recording_(recording),
      key_(key),
      dimension_(recording.about().dimension()),
      same_surface_(same(recording.about().structure().surface(), surface)) {
  if (same_surface_) return;
  if (dimension_ == 3) {
    throw InputError(key_ +
                     ": this structure's surface is not the recorded one; in three dimensions a record is played to "
                     "the same surface only");
  }
  find_places(surface);
}

void LoadHistory::find_places(const wire::Surface& surface) {
  polyline_ = polyline_of(surface);
  std::vector<std::uint32_t> all(polyline_->segment_count());
  std::iota(all.begin(), all.end(), 0U);
  double size = 0.0;
  for (const double x : surface.position()) size = std::max(size, std::abs(x));
  tolerance_ = beside * size;
  const wire::Surface& recorded = recording_.about().structure().surface();
  for (int i = 0; i < recorded.position_size() / 2; ++i) places_.push_back(polyline_->closest(node(recorded, i), all));
}

void LoadHistory::agree(double window, double end) {
  window_ = window;
  same_windows_ = window == recording_.about().window();
  // The last impulse acts for half a window more.
  if (end > (recording_.end() + 0.5 * recording_.about().window()) * (1.0 + round_off)) require_over(end);
}

void LoadHistory::require_over(double end) {
  const auto without = static_cast<std::uint64_t>(std::ceil(rest * static_cast<double>(recording_.last())));
  for (std::uint64_t back = 0; back <= without; ++back) {
    const auto last = recording_.impulse(recording_.last() - std::min(back, recording_.last()));
    if (std::ranges::all_of(last, [](double value) { return value == 0.0; })) continue;
    throw InputError(key_ + ": the record ends at " + rounded_text(recording_.end(), 6) +
                     " s while the load still acts, and this run is to end at " + rounded_text(end, 6) +
                     " s. End it earlier (time.end), or record a longer run");
  }
}

template <typename Each>
void LoadHistory::for_each_part(std::uint64_t window, Each each) {
  if (same_windows_) {
    if (window <= recording_.last()) each(window, 1.0);
    return;
  }
  const double recorded = recording_.about().window();
  const double from = window == 0 ? 0.0 : (static_cast<double>(window) - 0.5) * window_;
  const double to = (static_cast<double>(window) + 0.5) * window_;
  auto n = static_cast<std::uint64_t>(std::floor(from / recorded + 0.5));
  for (; n <= recording_.last(); ++n) {
    const double begins = n == 0 ? 0.0 : (static_cast<double>(n) - 0.5) * recorded;
    const double ends = (static_cast<double>(n) + 0.5) * recorded;
    if (begins >= to) return;
    const double common = std::min(to, ends) - std::max(from, begins);
    if (common > 0.0) each(n, common / (ends - begins));
  }
}

void LoadHistory::impulse(std::uint64_t window, std::span<double> out) {
  std::fill(out.begin(), out.end(), 0.0);
  for_each_part(window, [&](std::uint64_t recorded, double part) { add(recorded, part, out); });
}

void LoadHistory::add(std::uint64_t recorded, double part, std::span<double> out) {
  const auto given = recording_.impulse(recorded);
  if (same_surface_) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += part * given[i];
    return;
  }
  for (std::size_t k = 0; k < places_.size(); ++k) {
    const surface::Vec2 one{part * given[2 * k], part * given[2 * k + 1]};
    if (one[0] == 0.0 && one[1] == 0.0) continue;
    const surface::ClosestPoint& at = places_[k];
    if (std::abs(at.distance) > tolerance_) {
      const wire::Surface& was = recording_.about().structure().surface();
      const surface::Vec2 x = node(was, static_cast<int>(k));
      throw InputError(key_ + ": the recorded load acts at x1 = " + rounded_text(x[0], 4) +
                       " m, x2 = " + rounded_text(x[1], 4) + " m, which is " + rounded_text(std::abs(at.distance), 2) +
                       " m beside this structure's surface. Play it to a structure whose loaded face is as long");
    }
    const auto& nodes = polyline_->segment(at.segment);
    const double shares[] = {1.0 - at.fraction, at.fraction};
    for (int end = 0; end < 2; ++end) {
      for (unsigned axis = 0; axis < 2; ++axis) out[2 * std::size_t{nodes[end]} + axis] += shares[end] * one[axis];
    }
  }
}

double LoadHistory::interpolated(std::span<const double> field, std::size_t node, unsigned axis) const {
  if (same_surface_) return field[dimension_ * node + axis];
  const surface::ClosestPoint& at = places_[node];
  const auto [first, second] = polyline_->segment(at.segment);
  return (1.0 - at.fraction) * field[2 * std::size_t{first} + axis] +
         at.fraction * field[2 * std::size_t{second} + axis];
}

void LoadHistory::add_retreat(std::uint64_t window, std::span<const double> velocity, Retreat& sums) {
  const double n = std::round(static_cast<double>(window) * window_ / recording_.about().window());
  if (!(n <= static_cast<double>(recording_.last()))) return;
  const auto recorded = static_cast<std::uint64_t>(n);
  const auto given = recording_.impulse(recorded);
  const auto was = recording_.velocity(recorded);
  for (std::size_t k = 0; k < given.size() / dimension_; ++k) {
    double size = 0.0;
    for (unsigned axis = 0; axis < dimension_; ++axis) {
      const std::size_t i = dimension_ * k + axis;
      if (given[i] == 0.0) continue;
      const double now = interpolated(velocity, k, axis);
      size += given[i] * given[i];
      sums.work += given[i] * now;
      sums.departure += given[i] * (now - was[i]);
    }
    sums.impulse += std::sqrt(size);
  }
}

}  // namespace grainstep::replay
