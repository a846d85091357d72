/// @file What has been handed over at the interface, as seen in the Forces messages that passed by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace grainstep::ledger {

using Vector = std::array<double, 3>;  ///< x1, x2, x3; the third stays zero in two dimensions

/// The impulses up to one window n, in N s, positive along the axes, of the force on the structure.
struct HandedOver {
  Vector before{};           ///< sum over windows 0..n-1
  Vector latest{};           ///< window n alone
  std::uint64_t acting = 0;  ///< windows up to n in which there was any impulse
  double peak = 0.0;         ///< largest sum over nodes of |impulse| of any window up to n
  double sizes = 0.0;        ///< sum of these sums: it never falls

  [[nodiscard]] Vector total() const { return {before[0] + latest[0], before[1] + latest[1], before[2] + latest[2]}; }
};

/// Adds up the windows in order.
class ImpulseSums {
 public:
  explicit ImpulseSums(std::size_t dimension) : dimension_(dimension) {}

  /// `impulse`: nodes x dimension, N s, the payload of Forces of the next window.
  void add(std::span<const double> impulse);

  [[nodiscard]] const HandedOver& handed_over() const { return sums_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive("sums of impulses", sums_);
  }

 private:
  std::size_t dimension_;
  HandedOver sums_;
};

}  // namespace grainstep::ledger
