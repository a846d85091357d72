/// @file The dashpot's rate gamma_n where contacts differ in effective mass.
#pragma once

#include <cmath>

namespace grainstep::contact {

/// gamma_n = x r(x) with x = dt sqrt(Kn/m_eff), r linear between equally spaced x. The same restitution at every mass
/// makes r all but constant: (2.3) says sqrt(4/(1 + (pi/ln e)^2))/dt, and a step's length takes some of it away
/// (docs/theory/particles.md). Plain data: shared with files compiled for other instruction sets.
struct DampingTable {
  static constexpr int nodes = 65;
  double scale = 0.0;            ///< sqrt(kg), dt sqrt(Kn)
  double first = 0.0;            ///< x of the first node
  double per_spacing = 0.0;      ///< one over the spacing of x
  double value[nodes + 1] = {};  ///< 1/s, r; the last one twice
};

/// 1/s; beyond the table's ends r stays. Inlined everywhere, so that no file uses another one's instructions.
[[gnu::always_inline]] static inline double damping_rate(const DampingTable& table, double effective_mass) {
  const double x = table.scale / std::sqrt(effective_mass);
  double at = (x - table.first) * table.per_spacing;
  at = at > 0.0 ? at : 0.0;
  at = at < DampingTable::nodes - 1 ? at : DampingTable::nodes - 1;
  const int node = static_cast<int>(at);
  const double part = at - node;
  return x * (table.value[node] + part * (table.value[node + 1] - table.value[node]));
}

}  // namespace grainstep::contact
