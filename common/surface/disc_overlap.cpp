#include "surface/disc_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace grainstep::surface {
namespace {

using std::numbers::pi;

double clockwise(const Vec2& from, const Vec2& to) {
  const double angle = std::atan2(from[1] * to[0] - from[0] * to[1], dot(from, to));
  return angle < 0.0 ? angle + 2.0 * pi : angle;
}

/// Integral of sin^4 from 0 to x. Small x: by powers, since the closed form cancels to the fifth of them.
double integral_of_sine4(double x) {
  constexpr double small = 0.7;
  if (x > small) return 0.375 * x - 0.25 * std::sin(2.0 * x) + std::sin(4.0 * x) / 32.0;
  // sin^4 = (3 - 4 cos 2x + cos 4x)/8, its power 2k: (-1)^k (4^(2k) - 4 2^(2k))/(8 (2k)!).
  const double x2 = x * x;
  double sum = 0.0;
  double of_two = 4.0 / 24.0 * 4.0 * x2 * x2 * x;  // 2^(2k)/(2k)! x^(2k+1), k = 2
  double of_four = 16.0 * of_two;
  for (int k = 2; k < 20; ++k) {
    const double term = (of_four - 4.0 * of_two) / (8.0 * (2 * k + 1));
    sum += k % 2 == 0 ? term : -term;
    if (std::abs(term) < 1e-17 * sum) break;
    const double next = x2 / ((2 * k + 1) * (2 * k + 2));
    of_two *= 4.0 * next;
    of_four *= 16.0 * next;
  }
  return sum;
}

/// A directed piece of a straight line, relative to the disc's centre: its distance along its left-hand normal, and the
/// places s of its ends along itself, from the point nearest to the centre.
struct Piece {
  Piece(const Vec2& from, const Vec2& to) : length(norm(to - from)) {
    if (!(length > 0.0)) return;
    const Vec2 along = (to - from) * (1.0 / length);
    normal = turned_left(along);
    height = dot(from, normal);
    begin = dot(from, along);
    end = dot(to, along);
  }
  double length;
  Vec2 normal;
  double height = 0.0, begin = 0.0, end = 0.0;
};

/// Its share of B, which lies to its right: the flux of x (R^2/2 - r^2/4), whose divergence is R^2 - r^2.
double flux(const Piece& piece, double radius) {
  const double h2 = piece.height * piece.height;
  const double cubes = piece.end * piece.end * piece.end - piece.begin * piece.begin * piece.begin;
  return piece.height * ((0.5 * radius * radius - 0.25 * h2) * (piece.end - piece.begin) - cubes / 12.0);
}

/// What of a segment between a and b, relative to the disc's centre, lies in the disc, in fractions of it.
struct Part {
  double from, to;
  bool enters, leaves;  ///< it crosses the circle there
};

/// Whether an end lies inside is decided for the node alone, so that the segments that meet there agree.
std::optional<Part> part_in_disc(const Vec2& a, const Vec2& b, double radius) {
  const double radius2 = radius * radius;
  const bool a_inside = dot(a, a) < radius2;
  const bool b_inside = dot(b, b) < radius2;
  if (a_inside && b_inside) return Part{0.0, 1.0, false, false};
  const Vec2 along = b - a;
  const double squared = dot(along, along);
  const double middle = -dot(a, along) / squared;
  const Vec2 nearest = a + middle * along;
  const double half = std::sqrt(std::max(0.0, radius2 - dot(nearest, nearest)) / squared);
  if (a_inside) return Part{0.0, std::clamp(middle + half, 0.0, 1.0), false, true};
  if (b_inside) return Part{std::clamp(middle - half, 0.0, 1.0), 1.0, true, false};
  if (!(half > 0.0) || !(middle > 0.0) || !(middle < 1.0)) return std::nullopt;
  return Part{std::max(0.0, middle - half), std::min(1.0, middle + half), true, true};
}

/// Integrals along a piece of R^2 - r^2, and of that times s.
struct Moments {
  Moments(const Piece& piece, double radius) {
    const double c2 = radius * radius - piece.height * piece.height;
    const double b2 = piece.begin * piece.begin;
    const double e2 = piece.end * piece.end;
    zeroth = c2 * (piece.end - piece.begin) - (e2 * piece.end - b2 * piece.begin) / 3.0;
    first = (e2 - b2) * (0.5 * c2 - 0.25 * (e2 + b2));
  }
  double zeroth, first;
};

}  // namespace

/// The end of an open piece: straight down into the structure, between the node and the disc's edge.
void DiscOverlapFinder::end_face(std::uint32_t node, const Vec2& at, const Vec2& normal, bool first) {
  const double up = dot(at, normal);
  const double down = up + std::sqrt(std::max(0.0, radius_ * radius_ - dot(at, at) + up * up));
  const Vec2 edge = at - down * normal;
  const Piece piece = first ? Piece(edge, at) : Piece(at, edge);
  const double weight = Moments(piece, radius_).zeroth;
  shares_->push_back({node, weight, weight * piece.normal});
  found_.measure += flux(piece, radius_);
  (first ? entries_ : exits_).push_back(edge);
}

void DiscOverlapFinder::segment(const Polyline& surface, const Vec2& centre, std::uint32_t index) {
  const auto [first, second] = surface.segment(index);
  const Vec2 a = surface.nodes()[first] - centre;
  const Vec2 b = surface.nodes()[second] - centre;
  const auto part = part_in_disc(a, b, radius_);
  if (!part) return;
  const Vec2 from = part->enters ? a + part->from * (b - a) : a;
  const Vec2 to = part->leaves ? a + part->to * (b - a) : b;
  const Piece whole(a, b);
  Piece piece = whole;
  piece.begin += part->from * whole.length;
  piece.end = whole.begin + part->to * whole.length;
  const Moments moments(piece, radius_);
  const double of_second = (moments.first - whole.begin * moments.zeroth) / whole.length;
  for (const auto& [node, weight] : {std::pair{first, moments.zeroth - of_second}, {second, of_second}}) {
    shares_->push_back({node, weight, weight * whole.normal});
  }
  found_.measure += flux(piece, radius_);
  if (part->enters) entries_.push_back(from);
  if (part->leaves) exits_.push_back(to);
  if (!part->enters && !surface.before(index)) end_face(first, a, whole.normal, true);
  if (!part->leaves && !surface.after(index)) end_face(second, b, whole.normal, false);
}

/// Closes the boundary from where the surface leaves the disc, clockwise to where it enters it: along the chord, and
/// with the segment of the circle beyond it, for which B = 4/3 R^4 times the integral of sin^4.
void DiscOverlapFinder::close() {
  for (const Vec2& exit : exits_) {
    double turn = 2.0 * pi;
    const Vec2* entry = &exit;
    for (const Vec2& candidate : entries_) {
      const double angle = clockwise(exit, candidate);
      if (angle >= turn) continue;
      turn = angle;
      entry = &candidate;
    }
    const double radius4 = radius_ * radius_ * radius_ * radius_;
    found_.measure += 4.0 / 3.0 * radius4 * integral_of_sine4(0.5 * turn) + flux(Piece(exit, *entry), radius_);
  }
}

DiscOverlap DiscOverlapFinder::find(const Polyline& surface, const Vec2& centre, double radius,
                                    std::span<const std::uint32_t> candidates, std::vector<NodeShare>& shares) {
  radius_ = radius;
  shares_ = &shares;
  found_ = {};
  entries_.clear();
  exits_.clear();
  const std::size_t first = shares.size();
  for (const std::uint32_t index : candidates) segment(surface, centre, index);
  close();
  for (std::size_t i = first; i < shares.size(); ++i) {
    found_.weight += shares[i].weight;
    found_.gradient += shares[i].gradient;
  }
  return found_;
}

// With the half angle x of the circular segment: B = 4/3 R^4 I(x), I the integral of sin^4; delta = R (1 - cos x);
// dB/d delta = 4/3 c^3 with the half chord c = R sin x.
FlatOverlap flat_overlap(double measure, double radius) {
  const double wanted = 0.75 * measure / (radius * radius * radius * radius);
  double x = std::min(std::pow(5.0 * wanted, 0.2), pi / 2.0);
  constexpr int enough = 60;
  for (int i = 0; i < enough; ++i) {
    const double sine2 = std::sin(x) * std::sin(x);
    const double change = (integral_of_sine4(x) - wanted) / std::max(sine2 * sine2, 1e-300);
    const double next = std::clamp(x - change, 0.5 * x, 0.5 * (x + pi));
    const bool still = std::abs(next - x) <= 1e-15 * x;
    x = next;
    if (still) break;
  }
  const double half = std::sin(0.5 * x);
  const double c = radius * std::sin(x);
  return {2.0 * radius * half * half, 0.75 / (c * c * c)};
}

double mean_length(const Polyline& surface) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < surface.segment_count(); ++i) sum += surface.length(i);
  return sum / static_cast<double>(surface.segment_count());
}

}  // namespace grainstep::surface
