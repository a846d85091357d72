/// @file The element loop and the node loops, compiled from one source (kernel.cpp) for three instruction sets and
/// chosen at run time. Nothing here allocates or throws, and nothing tests for NaN: the kernel is compiled with
/// -ffast-math.
#pragma once

#include <cstddef>
#include <span>

#include "fe-service/bulk_viscosity.hpp"
#include "fe-service/kernel/layout.hpp"
#include "fe-service/materials/laws.hpp"
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
struct RowSweep : RowOutcome {
  NodeRow upper, lower, centre;
  ForceRow upper_force, lower_force, centre_force;
  bool first_row = false;     ///< upper_force is set instead of added to; lower_force is always set
  bool leave_upper = false;   ///< to upper_force nothing is done yet, but by Kernels::finish_upper with this scratch
  double* state = nullptr;    ///< layout.hpp
  double* scratch = nullptr;  ///< scratch_size(quads) doubles, aligned
  int quads = 0;
  double step = 0.0;  ///< s
  // results of bulk viscosity
  double viscous_work = 0.0;  ///< J, of this step
  double viscosity = 0.0;     ///< Pa s, the largest slope of stress against rate of volume
};

constexpr std::size_t padded(int quads) {
  const auto lanes = static_cast<std::size_t>(kBatchQuads);
  return (static_cast<std::size_t>(quads) + lanes - 1) / lanes * lanes;
}
constexpr std::size_t scratch_row(int quads) { return padded(quads) + 2 * static_cast<std::size_t>(kBatchQuads); }
constexpr std::size_t scratch_size(int quads) { return 8 * scratch_row(quads); }

/// Of omega^2, relative.
inline constexpr double kFrequencyTolerance = 1e-4;

/// Stress at the end of the step and internal nodal forces from it, of one row: the loop's copies for a law.
template <class Law>
struct Sweep {
  void (*plane_strain)(RowSweep&, const Law&, const PlaneStrain&);
  void (*axisymmetric)(RowSweep&, const Law&, const Axisymmetric&);

  void operator()(RowSweep& row, const Law& law, const Measure& measure) const {
    if (const auto* plane = std::get_if<PlaneStrain>(&measure)) return plane_strain(row, law, *plane);
    axisymmetric(row, law, std::get<Axisymmetric>(measure));
  }
};

/// The loop's copies for all laws: the one for the law that is given is called.
template <class... Law>
struct Sweeps : Sweep<Law>... {
  using Sweep<Law>::operator()...;
};

/// Adds the forces of bulk viscosity to those of the sweep before, from `stress`, one number for each quad (padded as
/// the row is): that of the step before, which becomes this one's.
struct Resist {
  void (*plane_strain)(RowSweep&, const BulkViscosity&, double* stress, const PlaneStrain&);
  void (*axisymmetric)(RowSweep&, const BulkViscosity&, double* stress, const Axisymmetric&);

  void operator()(RowSweep& row, const BulkViscosity& law, double* stress, const Measure& measure) const {
    if (const auto* plane = std::get_if<PlaneStrain>(&measure)) return plane_strain(row, law, stress, *plane);
    axisymmetric(row, law, stress, std::get<Axisymmetric>(measure));
  }
};

/// What lumped masses of a row's undeformed quads follow from.
struct QuadMass {
  double areal;  ///< kg/m, density x area: the mass of a unit thickness
  double left;   ///< m, x1 where the first quad begins
  double width;  ///< m, of a quad
};

/// An upper bound of omega^2 of all quads of a row (upper, lower and centre positions, quads), 1/s^2, not below
/// `at_least` and, where above, within kFrequencyTolerance of the smallest there is (kernel/frequency.hpp).
struct LargestFrequency {
  double (*plane_strain)(const RowSweep&, const Elastic&, const QuadMass&, const PlaneStrain&, double at_least);
  double (*axisymmetric)(const RowSweep&, const Elastic&, const QuadMass&, const Axisymmetric&, double at_least);

  double operator()(const RowSweep& row, const Elastic& law, const QuadMass& mass, const Measure& measure,
                    double at_least) const {
    if (const auto* plane = std::get_if<PlaneStrain>(&measure)) return plane_strain(row, law, mass, *plane, at_least);
    return axisymmetric(row, law, mass, std::get<Axisymmetric>(measure), at_least);
  }
};

struct Kernels {
  const char* name;
  Laws::Apply<Sweeps> sweep;
  /// The forces on the upper corners of a row that left them.
  void (*finish_upper)(RowSweep& row);
  Resist resist;
  LargestFrequency largest_frequency;
  /// velocity += weight * force * inverse_mass
  void (*kick)(double* velocity, const double* force, const double* inverse_mass, double weight, std::size_t n);
  /// position += step * velocity
  void (*drift)(double* position, const double* velocity, double step, std::size_t n);
};

/// All that this machine can run, the fastest first.
std::span<const Kernels* const> available_kernels();

}  // namespace grainstep::fe
