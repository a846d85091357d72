// Sandwich core in the element loop: a shock against the jump conditions, a patch test, and a small sandwich beam on
// three meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "../support/fe_motion.hpp"
#include "../support/fe_scenes.hpp"
#include "fe-service/layers.hpp"
#include "support/verification_record.hpp"

namespace grainstep::fe {
namespace {

using verification::check;

/// rho_c/rho_m = 0.1, s_c = 0.11.
Core make_law(double poisson, double viscosity) {
  return {Elastic::from_young(20e9, poisson, 800.0), 0.011 * 470e6, -std::log(0.15), 20e9, viscosity, 0.011 * 470e6};
}

// ---- shock ----------------------------------------------------------------------------------------------------------

/// Behind an elastic precursor of sigma_c the core is crushed by a shock that runs with U through the undeformed core.
/// Jumps of mass and momentum, nominal strain e, and the law behind the front (no Poisson effect, at rest):
///     V - v1 = U (e2 - e1),  s2 - sigma_c = rho U (V - v1),  -ln(1 - e2) = s2/E + c_D + (s2 - sigma_c)/E_t
/// With E and E_t infinite that is s2 = sigma_c + rho V^2/eps_D, U = V/eps_D.
struct Shock {
  double speed, stress;
};

Shock jump_conditions(const Core& law, double piston) {
  const double young = law.elastic.longitudinal_modulus();
  const double density = law.elastic.density;
  const double before = -std::expm1(-law.strength / young);
  const double drive = piston - law.strength / std::sqrt(density * young);
  const auto law_stress = [&](double e) {
    return (-std::log1p(-e) - law.densified + law.strength / law.tangent) / (1.0 / young + 1.0 / law.tangent);
  };
  double low = -std::expm1(-law.densified);
  double high = 0.999;
  for (int i = 0; i < 200; ++i) {
    const double e = 0.5 * (low + high);
    (law.strength + density * drive * drive / (e - before) > law_stress(e) ? low : high) = e;
  }
  return {drive / (low - before), law_stress(low)};
}

constexpr double kShockElement = 0.5e-3;
constexpr double kColumn = 0.2;

/// Depth below the face at which the compaction passes half of c_D, undeformed, m.
double front(const Body& body, const Core& law) {
  const auto mean = [&body](int row) {
    double sum = 0.0;
    for (int t = 0; t < kQuadTriangles; ++t) sum += 0.25 * body.plastic_strain(row, 0, t);
    return sum;
  };
  int row = 0;
  while (mean(row) > 0.5 * law.densified) ++row;
  const double part = (mean(row - 1) - 0.5 * law.densified) / (mean(row - 1) - mean(row));
  return (row - 0.5 + part) * kShockElement;
}

class CoreShock : public testing::TestWithParam<double> {};

TEST_P(CoreShock, SpeedAndStressAreThoseOfTheJumpConditions) {
  const double piston = GetParam();
  const double width = 4.0 * kShockElement;
  Core law = make_law(0.0, 0.0);
  law.viscosity = width * law.elastic.density * piston / 0.85;  // (3.10)
  const scene::Structure structure =
      test::beam(scene::Layer::MATERIAL_ELASTIC, 2.0 * kShockElement, kColumn, 0.5 * kColumn / kShockElement);
  Body body(make_mesh(structure), {law}, PlaneStrain{1e-3});
  const double end = 1.9 * kColumn / std::sqrt(law.elastic.longitudinal_modulus() / law.elastic.density);
  double time = 0.0;
  double first_time = 0.0;
  double first_front = 0.0;
  double stress = 0.0;
  int samples = 0;
  double step = 0.0;
  for (int n = 0; time < end; ++n) {
    const double before = step;
    if (n % 20 == 0) step = 0.8 * body.stable_step();
    body.kick(0.5 * (before + step));
    test::for_each_node(body, [](Nodes& nodes, std::size_t i) { nodes.u[i] = 0.0; });
    for (int column = 0; column <= body.mesh().columns; ++column) {
      body.corners.v[body.mesh().corner({0, column})] = -piston;
    }
    body.drift(step);
    body.sweep(step);
    time += step;
    if (time < 0.5 * end) continue;
    if (first_time == 0.0) {
      first_time = time;
      first_front = front(body, law);
    }
    for (int t = 0; t < kQuadTriangles; ++t) stress -= body.stress(0, 0, t).yy;
    samples += kQuadTriangles;
  }
  const Shock exact = jump_conditions(law, piston);
  const std::string name = "Shock in a sandwich core, piston at " + std::to_string(static_cast<int>(piston)) + " m/s";
  check({.group = "structure",
         .name = name,
         .quantity = "speed of the front",
         .unit = "m/s",
         .reference = "closed form",
         .origin = "jump conditions, law (3.6) with (3.9)",
         .expected = exact.speed,
         .found = (front(body, law) - first_front) / (time - first_time),
         .tolerance = 0.01,
         .reason = "discretisation: the front passes some 20 to 40 elements"});
  check({.group = "structure",
         .name = name,
         .quantity = "stress on the piston",
         .unit = "Pa",
         .reference = "closed form",
         .origin = "jump conditions, law (3.6) with (3.9)",
         .expected = exact.stress,
         .found = stress / samples,
         .tolerance = 0.02,
         .reason = "discretisation: mean over the second half of the time, with the ripple of elements that lock"});
}

INSTANTIATE_TEST_SUITE_P(Pistons, CoreShock, testing::Values(300.0, 600.0));

// ---- patch ----------------------------------------------------------------------------------------------------------

// A linear velocity field crushes, stretches and shears a mesh of distorted elements: all triangles have the same
// stress (they have turned alike), and no inner node is pulled.
TEST(CorePatch, HomogeneousFlowOnADistortedMesh) {
  const Core law = make_law(0.25, 6e3);
  const scene::Structure structure = test::beam(scene::Layer::MATERIAL_ELASTIC, 9e-3, 8e-3, 4);
  Body body(make_mesh(structure), {law}, PlaneStrain{1e-3});
  std::mt19937 random(2);
  const auto shift = [&random] { return 0.2e-3 * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0); };
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    nodes.x[i] += shift();
    nodes.y[i] += shift();
  });
  const double step = 1e-7;
  for (int n = 0; n < 300; ++n) {
    test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
      nodes.u[i] = 5e3 * nodes.x[i] + 4e3 * nodes.y[i];
      nodes.v[i] = 2e3 * nodes.x[i] - 3e4 * nodes.y[i];
    });
    body.drift(step);
    body.sweep(step);
  }
  const Stress first = body.stress(0, 0, 0);
  double spread = 0.0;
  test::for_each_triangle(body, [&](int row, int column, int triangle) {
    const Stress s = body.stress(row, column, triangle);
    spread = std::max({spread, std::abs(s.xx - first.xx), std::abs(s.yy - first.yy), std::abs(s.xy - first.xy),
                       std::abs(s.zz - first.zz)});
  });
  double pull = 0.0;
  for (int row = 1; row < body.mesh().row_count(); ++row) {
    for (int column = 1; column < body.mesh().columns; ++column) {
      const std::size_t i = body.mesh().corner({row, column});
      pull = std::max(pull, std::hypot(body.corners.fx[i], body.corners.fy[i]));
    }
  }
  EXPECT_GT(body.plastic_strain(3, 3, 0), 0.5);  // real crushing
  const std::string name = "Patch test, sandwich core";
  check({.group = "structure",
         .name = name,
         .quantity = "spread of stress / largest component",
         .unit = "",
         .reference = "closed form",
         .origin = "a linear field has one stress",
         .expected = 0.0,
         .found = spread / std::abs(first.yy),
         .tolerance = 1e-9,
         .reason = "exact: round-off of positions, stiffness over strength = 4e3"});
  check({.group = "structure",
         .name = name,
         .quantity = "force on inner nodes / (stress x side x depth)",
         .unit = "",
         .reference = "closed form",
         .origin = "a constant stress is in equilibrium",
         .expected = 0.0,
         .found = pull / (std::abs(first.yy) * 1e-3 * 1e-3),
         .tolerance = 1e-9,
         .reason = "exact: round-off, as above"});
}

// ---- mesh -----------------------------------------------------------------------------------------------------------

struct Response {
  double deflection, compression;  ///< largest, over the half span and the core's thickness
  double roughness;                ///< of the compaction along the front of the core, element to element
};

/// Gives the loaded face a velocity over a fifth of the half span, with the same momentum on any mesh.
void kick_face(Body& body, double velocity) {
  const Mesh& mesh = body.mesh();
  const auto push = [velocity](Nodes& nodes, std::size_t i, double mass) {
    nodes.v[i] += velocity * mass * nodes.inverse_mass[i];
  };
  for (int row = 0; mesh.rows[row].layer == 0; ++row) {
    for (int column = 0; column < mesh.columns / 5; ++column) {
      const std::size_t centre = row * mesh.centre_stride() + column;
      const double third = body.centres.mass[centre];
      push(body.centres, centre, third);
      for (const Corner c :
           {Corner{row, column}, Corner{row, column + 1}, Corner{row + 1, column}, Corner{row + 1, column + 1}}) {
        push(body.corners, mesh.corner(c), 0.5 * third);
      }
    }
  }
}

/// A tenth of the small reference sandwich (c/L = 0.33, s_c = 0.11) under a kick of its loaded face.
Response kicked_beam(double refinement) {
  scene::Structure structure = test::beam(scene::Layer::MATERIAL_DH36, 0.05, 5e-3 / 3.0, refinement);
  *structure.add_layers() = test::core(16.5e-3, 8000.0 * (5e-3 / 3.0) / 16.5e-3, 0.1 * 165e-3 * 808.0 * 40.0 / 0.848);
  *structure.add_layers() = test::steel(scene::Layer::MATERIAL_DH36, 5e-3 / 3.0);
  test::set_core(structure, 0.11);
  Body body(make_mesh(structure), make_layers(structure), PlaneStrain{1e-3});
  const Mesh& mesh = body.mesh();
  kick_face(body, -150.0);
  Response response{0.0, 0.0, 0.0};
  double step = 0.0;
  double time = 0.0;
  for (int n = 0; time < 2e-4; ++n) {
    const double before = step;
    if (n % 10 == 0) step = 0.9 * body.stable_step();
    body.kick(0.5 * (before + step));
    body.hold_supports();
    body.drift(step);
    EXPECT_EQ(body.sweep(step).unconverged, 0);
    time += step;
    response.deflection = std::max(response.deflection, back_deflection(body) / 0.05);
    response.compression = std::max(response.compression, core_compression(body).value());
  }
  int core_row = 0;
  while (mesh.rows[core_row].layer == 0) ++core_row;
  double jumps = 0.0;
  double sum = 0.0;
  const auto mean = [&](int column) {
    double found = 0.0;
    for (int t = 0; t < kQuadTriangles; ++t) found += 0.25 * body.plastic_strain(core_row + 1, column, t);
    return found;
  };
  for (int column = 1; column + 1 < mesh.columns; ++column) {
    jumps += std::abs(mean(column - 1) - 2.0 * mean(column) + mean(column + 1));
    sum += mean(column);
  }
  response.roughness = jumps / sum;
  return response;
}

verification::Comparison difference(const std::string& quantity, double coarse, double fine, double tolerance) {
  return {.group = "convergence",
          .name = "Sandwich beam under a kick of its loaded face, mesh",
          .quantity = quantity,
          .unit = "",
          .reference = "twice as fine",
          .origin = "4 elements in a face, fe_core.cpp",
          .expected = fine,
          .found = coarse,
          .tolerance = tolerance,
          .reason = "discretisation: 2 elements in a face"};
}

// The core is crushed by a fifth and sheared beside the kick; elements that lock would be too stiff by more than a few
// per cent on the coarse mesh and hardly improve, elements that hourglass would show a pattern from column to column.
TEST(CoreMesh, NeitherLocksNorHourglasses) {
  const Response coarse = kicked_beam(1.0);
  const Response middle = kicked_beam(2.0);
  const Response fine = kicked_beam(4.0);
  check(difference("largest core compression", middle.compression, fine.compression, 0.01));
  check(difference("largest deflection", middle.deflection, fine.deflection, 0.03));
  // Better than first order.
  EXPECT_GT(middle.compression - coarse.compression, 2.5 * std::abs(fine.compression - middle.compression));
  EXPECT_GT(middle.deflection - coarse.deflection, 2.5 * std::abs(fine.deflection - middle.deflection));
  // Second differences of a smooth compaction fall with the square of the element, where its front is with the element.
  EXPECT_LT(middle.roughness, 0.6 * coarse.roughness);
  EXPECT_LT(fine.roughness, 0.6 * middle.roughness);
  EXPECT_LT(fine.roughness, 0.01);
}

}  // namespace
}  // namespace grainstep::fe
