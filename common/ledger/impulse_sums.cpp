#include "ledger/impulse_sums.hpp"

#include <algorithm>
#include <cmath>

namespace grainstep::ledger {

void ImpulseSums::add(std::span<const double> impulse) {
  sums_.before = sums_.total();
  sums_.latest = {};
  double magnitude = 0.0;
  for (std::size_t i = 0; i < impulse.size(); ++i) {
    sums_.latest[i % dimension_] += impulse[i];
    magnitude += std::abs(impulse[i]);
  }
  if (magnitude > 0.0) ++sums_.acting;
  sums_.peak = std::max(sums_.peak, magnitude);
  sums_.sizes += magnitude;
}

}  // namespace grainstep::ledger
