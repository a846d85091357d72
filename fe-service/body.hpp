/// @file The deformable body: nodes, elements, masses and supports, and the elementary moves of a time step.
#pragma once

#include <vector>

#include "base/team.hpp"
#include "fe-service/kernel/kernel.hpp"
#include "fe-service/materials/material.hpp"
#include "fe-service/mesh.hpp"
#include "fe-service/triangle.hpp"

namespace grainstep::fe {

/// Arrays over corner or centre nodes, laid out as in kernel/layout.hpp.
struct Nodes {
  Array x, y;          ///< m
  Array x0, y0;        ///< m, undeformed
  Array u, v;          ///< m/s, at the middle of the step
  Array fx, fy;        ///< N, internal
  Array mass;          ///< kg; 0 in the padding
  Array inverse_mass;  ///< 1/kg; 0 in the padding

  /// What a step changes.
  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed("x", x);
    archive.fixed("y", y);
    archive.fixed("u", u);
    archive.fixed("v", v);
    archive.fixed("fx", fx);
    archive.fixed("fy", fy);
  }
};

struct SweepResult {
  double plastic_work = 0.0;  ///< J
  double viscous_work = 0.0;  ///< J, of bulk viscosity
  double stored = 0.0;        ///< J, by which stored energy grew; of foam only
  double min_quality = 0.0;   ///< smallest element area over its undeformed area
  int unconverged = 0;        ///< batches in which the material's iteration did not converge
};

/// What a body of that mesh takes, without building it.
[[nodiscard]] std::size_t memory_bytes(const Mesh& mesh, const std::vector<Material>& layers);

class Body {
 public:
  /// `layers` by layer index of the mesh.
  Body(Mesh mesh, std::vector<Material> layers, const Measure& measure,
       const Kernels& kernels = *available_kernels().front());

  /// Rows are shared among `team`, which outlives the body; results do not depend on its size.
  void share_among(base::Team& team);

  /// Bulk viscosity of all rows; before the first sweep.
  void resist_volume(const BulkFactors& factors);

  /// Stress at the end of a step that lasted `step`, and the internal forces there.
  SweepResult sweep(double step);

  /// Adds weight/mass x internal force to all velocities; weight in s.
  void kick(double weight);

  /// Stops the supported degrees of freedom: all at x1 = L (and -L), u1 on the plane or axis of symmetry. Returns the
  /// impulse, N s, that the supports gave for it.
  Vec2 hold_supports();

  /// Sum of the internal forces along x1, N. Zero in plane strain; in a solid of revolution what its hoops pull inwards
  /// with: each slice feels it from its neighbours, like a support.
  [[nodiscard]] double radial_force() const;

  void drift(double step);

  /// 2/omega_max of the stiffest quad in its present shape with its share of the mass, s: an upper bound of omega_max
  /// of the assembled body, so a lower one of its true limit. Plastic flow only softens.
  [[nodiscard]] double stable_step() const;
  /// The same of one quad.
  [[nodiscard]] double stable_step(int row, int column) const;

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const Measure& measure() const { return measure_; }
  [[nodiscard]] const Material& material(int row) const { return layers_[mesh_.rows[row].layer]; }
  [[nodiscard]] double mass() const;
  [[nodiscard]] std::size_t memory_bytes() const { return fe::memory_bytes(mesh_, layers_); }

  /// State component of a triangle (layout.hpp).
  [[nodiscard]] double state(int component, int row, int column, int triangle) const;
  [[nodiscard]] Stress stress(int row, int column, int triangle) const;
  /// All round, of the quad's bulk viscosity, Pa; not part of stress().
  [[nodiscard]] double viscous_stress(int row, int column) const;
  /// Equivalent plastic strain; of a core its compaction, the transverse compressive plastic strain; 0 for a material
  /// without plasticity.
  [[nodiscard]] double plastic_strain(int row, int column, int triangle) const;
  /// Corner a, corner b and centre of a triangle, in m.
  struct TriangleNodes {
    Vec2 a, b, centre;
    [[nodiscard]] double area() const { return 0.5 * cross(a - centre, b - centre); }
  };
  [[nodiscard]] TriangleNodes triangle(int row, int column, int triangle) const;

  Nodes corners, centres;

  /// What a step changes, of a body of the same mesh and layers.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("corners", corners);
    archive("centres", centres);
    archive.fixed("elements", state_);
    for (Resistance& row : resistance_) {
      archive("viscosity", row.viscosity);
      archive.fixed("viscous stress", row.stress);
    }
  }

 private:
  /// What each row needs of its own while others are swept at the same time: two rows share the corners between them.
  struct Apart {
    Array scratch, viscous_scratch;
    RowSweep swept, viscous;  ///< the forces on their upper corners are still to be added
  };

  [[nodiscard]] RowSweep row_view(int row) const;
  [[nodiscard]] RowSweep row_to_sweep(int row, double step, double* scratch);
  void sweep_one(int row, RowSweep& view);
  void resist(int row, RowSweep& view);
  void sweep_apart(int row, double step);
  SweepResult sweep_all_apart(double step);
  void add_up(int row, const RowSweep& view, SweepResult& result) const;
  [[nodiscard]] QuadMass quad_mass(int row) const;
  [[nodiscard]] double limit_of(double omega_squared) const;
  void place_nodes();
  void share_mass();
  void create_state();
  void fill_state(int row, int component, double value);

  Mesh mesh_;
  std::vector<Material> layers_;
  Measure measure_;
  const Kernels* kernels_;
  std::vector<Array> state_;  ///< by row of elements
  Array scratch_;
  base::Team* team_ = nullptr;  ///< nullptr: one thread
  std::vector<Apart> apart_;    ///< of each row, or none

  /// Of a row of elements.
  struct Resistance {
    BulkViscosity law;
    double viscosity;  ///< Pa s, largest now
    Array stress;      ///< Pa, of each quad; tension is positive
  };
  std::vector<Resistance> resistance_;  ///< empty without bulk viscosity
};

}  // namespace grainstep::fe
