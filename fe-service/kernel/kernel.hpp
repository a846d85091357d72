/// @file The element loop and the node loops, compiled from one source (kernel.cpp) for three instruction sets and
/// chosen at run time. Nothing here allocates or throws, and nothing tests for NaN: the kernel is compiled with
/// -ffast-math.
#pragma once

#include <cstddef>
#include <span>

#include "fe-service/kernel/layout.hpp"
#include "fe-service/materials/core.hpp"
#include "fe-service/materials/dh36.hpp"
#include "fe-service/materials/foam.hpp"
#include "fe-service/measure.hpp"

namespace grainstep::fe {

struct NodeRow {
  const double* x;  ///< m, at the end of the step
  const double* y;
  const double* u;  ///< m/s, mean velocity of the step
  const double* v;
};

struct ForceRow {
  double* x;  ///< N
  double* y;
};

/// One row of quads over one step.
struct RowSweep {
  NodeRow upper, lower, centre;
  ForceRow upper_force, lower_force, centre_force;
  bool first_row = false;     ///< upper_force is set instead of added to; lower_force is always set
  double* state = nullptr;    ///< layout.hpp
  double* scratch = nullptr;  ///< scratch_size(quads) doubles, aligned
  int quads = 0;
  double step = 0.0;  ///< s
  // results
  double plastic_work = 0.0;    ///< J, of this step
  double min_twice_area = 0.0;  ///< m^2, at the end of the step
  int yielding = 0;             ///< batches with plastic flow
  int unconverged = 0;          ///< batches whose local iteration did not converge
};

constexpr std::size_t padded(int quads) {
  const auto lanes = static_cast<std::size_t>(kBatchQuads);
  return (static_cast<std::size_t>(quads) + lanes - 1) / lanes * lanes;
}
constexpr std::size_t scratch_row(int quads) { return padded(quads) + 2 * static_cast<std::size_t>(kBatchQuads); }
constexpr std::size_t scratch_size(int quads) { return 8 * scratch_row(quads); }

/// Of omega^2, relative.
inline constexpr double kFrequencyTolerance = 1e-4;

struct Kernels {
  const char* name;
  /// Stress at the end of the step and internal nodal forces from it, of one row.
  void (*sweep_elastic)(RowSweep&, const Elastic&, const PlaneStrain&);
  void (*sweep_dh36)(RowSweep&, const Dh36&, const PlaneStrain&);
  void (*sweep_core)(RowSweep&, const Core&, const PlaneStrain&);
  void (*sweep_foam)(RowSweep&, const Foam&, const PlaneStrain&);
  /// An upper bound of omega^2 of all quads of a row (upper, lower and centre positions, quads), 1/s^2, not below
  /// `at_least` and, where above, within kFrequencyTolerance of the smallest there is. `quad_mass` is that of a unit
  /// thickness, kg/m (kernel/frequency.hpp).
  double (*largest_frequency)(const RowSweep&, const Elastic&, double quad_mass, double at_least);
  /// velocity += weight * force * inverse_mass
  void (*kick)(double* velocity, const double* force, const double* inverse_mass, double weight, std::size_t n);
  /// position += step * velocity
  void (*drift)(double* position, const double* velocity, double step, std::size_t n);
};

/// All that this machine can run, the fastest first.
std::span<const Kernels* const> available_kernels();

}  // namespace grainstep::fe
