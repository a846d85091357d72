/// @file What the kernel works on: constants of the law, a batch of touching pairs component by component, and sums.
/// Plain data, for it is shared with files compiled for other instruction sets.
#pragma once

#include "contact/damping_table.hpp"

namespace grainstep::dem {

constexpr int batch_lanes = 8;       ///< the kernel works on so many pairs at a time, whatever the vectors' length
constexpr int batch_capacity = 128;  ///< a multiple of batch_lanes; its arrays stay in the nearest cache

/// (2.1), (2.2) between particles.
struct PairLaw {
  double normal_stiffness = 0.0;                         ///< N/m, Kn
  double tangential_stiffness = 0.0;                     ///< N/m, Ks
  double damping_rate = 0.0;                             ///< 1/s, gamma_n
  double friction = 0.0;                                 ///< mu
  const contact::DampingTable* damping_table = nullptr;  ///< read instead of damping_rate where sizes are mixed
};

/// Which parts of the law a scene needs.
struct PairFeatures {
  int dimension = 2;
  bool friction = true;  ///< else neither tangential spring nor torque
  bool energy = true;    ///< the sums are wanted
  bool mixed = false;    ///< particles of several masses: gamma_n comes from the table
};

/// What a touching pair hands on to the next step. Vectors have `dimension` components, torques one in the plane.
struct HistoryLayout {
  int dashpot = 0;  ///< 1/s kg, the dashpot's force over the branch vector, m_eff gamma_n (v.r)/r^2
  int spring = 1;   ///< m, on the first of the pair; the other one has it with the opposite sign
  int torque = 0;   ///< N, of both particles: -radius times this
  int values = 0;
};

constexpr int most_history_values = 7;

constexpr HistoryLayout history_layout(int dimension, bool friction) {
  const int turning = dimension == 3 ? 3 : 1;
  return {0, 1, 1 + dimension, friction ? 1 + dimension + turning : 1};
}

/// Pairs whose particles may touch, first minus second; all lanes up to the next multiple of batch_lanes are set.
struct PairBatch {
  alignas(64) double branch[3][batch_capacity];       ///< m, between the centres
  alignas(64) double velocity[3][batch_capacity];     ///< m/s, at t(n-1/2)
  alignas(64) double rolling[3][batch_capacity];      ///< m/s, radius times spin, summed; in the plane only [0]
  alignas(64) double reach[batch_capacity];           ///< m, sum of the radii
  alignas(64) double effective_mass[batch_capacity];  ///< kg
  alignas(64) double force[3][batch_capacity];        ///< N, on the first particle
  int count = 0;
};

/// Lane by lane, so that their bits do not depend on the vectors' length.
struct PairSums {
  alignas(64) double damping[batch_lanes] = {};     ///< J, dissipated by dashpots
  alignas(64) double tangential[batch_lanes] = {};  ///< J, into tangential springs and sliders
  alignas(64) double stored_normal[batch_lanes] = {};
  alignas(64) double stored_tangential[batch_lanes] = {};
  alignas(64) double largest_overlap[batch_lanes] = {};  ///< over the sum of the radii
};

/// `history`: for every value of HistoryLayout the batch's first; of t(n-1) before, zero for a new contact, of t(n)
/// after. `grown`: s, in which springs have grown since the last step, dt or 0 at the start.
using PairKernel = void (*)(const PairLaw& law, double grown, PairBatch& batch, double* const* history, PairSums& sums);

/// Copies for this machine, the fastest first.
struct PairKernels {
  const char* name;
  PairKernel kernel[2][2][2][2];  ///< [dimension - 2][friction][energy][mixed]
  [[nodiscard]] PairKernel of(const PairFeatures& features) const {
    return kernel[features.dimension - 2][features.friction ? 1 : 0][features.energy ? 1 : 0][features.mixed ? 1 : 0];
  }
};

}  // namespace grainstep::dem
