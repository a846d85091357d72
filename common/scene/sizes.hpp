/// @file Diameters of a slug's particles, as its size_distribution says. Pure functions; lengths over
/// particle.diameter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "grainstep/scene.pb.h"

namespace grainstep::scene {

/// Widest range that a slug may have, largest over smallest diameter: neighbour lists reach as far as the largest
/// particle, steps are as short as the smallest one wants them.
inline constexpr double widest_range_of_sizes = 10.0;

/// Mass goes with this power of a particle's diameter: 3 for spheres, 2 for discs.
[[nodiscard]] inline int dimension(const Scene& scene) { return scene.symmetry() == SYMMETRY_AXISYMMETRIC ? 3 : 2; }

class Sizes {
 public:
  /// All equal.
  Sizes() = default;
  /// @pre the distribution keeps size_problems()'s rules. `dimension`: 2 for discs, 3 for spheres.
  Sizes(const Slug& slug, int dimension);

  /// All sizes between two alike.
  [[nodiscard]] static Sizes between(double from, double to) {
    Sizes out;
    out.classes_ = {{from, to, 1.0}};
    return out;
  }

  [[nodiscard]] bool equal() const { return smallest() == largest(); }
  [[nodiscard]] double smallest() const { return classes_.front().from; }
  [[nodiscard]] double largest() const { return classes_.back().to; }

  /// Number mean of the k-th power.
  [[nodiscard]] double mean_of_power(int k) const;

  /// The size that a share of the particles, 0 < share < 1, does not exceed, by number.
  [[nodiscard]] double not_exceeded_by(double share) const;

  /// Of `count` particles, the largest first: the sizes that shares (i + 1/2)/count do not exceed, so that a histogram
  /// differs from the distribution by one particle at most.
  [[nodiscard]] std::vector<double> descending(std::uint64_t count) const;

 private:
  /// Sizes between `from` and `to`, all alike.
  struct Class {
    double from, to;
    double share;  ///< by number, of this and all smaller ones
  };
  std::vector<Class> classes_{{1.0, 1.0, 1.0}};
};

/// What is wrong with it: path below impactor.slug.size_distribution and text. Empty if nothing is.
struct SizeProblem {
  std::string path, text;
};
[[nodiscard]] std::vector<SizeProblem> size_problems(const SizeDistribution& distribution);

}  // namespace grainstep::scene
