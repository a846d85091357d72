// Bulk viscosity at an element, its work, and the step that it leaves; on every instruction set of this machine.
#include "fe-service/bulk_viscosity.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "../../support/fe_motion.hpp"
#include "../../support/fe_scenes.hpp"
#include "fe-service/structure.hpp"

namespace grainstep::fe {
namespace {

constexpr BulkFactors kFactors{.linear = 0.06, .quadratic = 1.2};

/// Quads of 1 mm, two rows of steel over two of something softer and lighter.
Body block(int columns, const BulkFactors& factors, const Measure& measure = PlaneStrain{1e-3},
           const Kernels& kernels = *available_kernels().front()) {
  scene::Structure structure = test::beam(scene::Layer::MATERIAL_ELASTIC, columns * 1e-3, 2e-3, 2);
  scene::Layer& soft = *structure.add_layers();
  soft = test::steel(scene::Layer::MATERIAL_ELASTIC, 2e-3);
  soft.set_young(70e9);
  soft.set_density(2700.0);
  Body body(make_mesh(structure), make_layers(structure), measure, kernels);
  body.resist_volume(factors);
  return body;
}

/// One step in which all of it grows at the same rates along x1 and x2 (of rings: r and z, and the hoops with r).
double grow(Body& body, double rate_1, double rate_2) {
  const double step = 1e-12;  // so short that geometry does not change
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    nodes.u[i] = rate_1 * nodes.x[i];
    nodes.v[i] = rate_2 * nodes.y[i];
  });
  body.drift(step);
  body.sweep(step);
  return step;
}

double power(const Body& body) {
  double sum = 0.0;
  for (const Nodes* nodes : {&body.corners, &body.centres}) {
    for (std::size_t i = 0; i < nodes->x.size(); ++i) {
      if (nodes->mass[i] > 0.0) sum += nodes->fx[i] * nodes->u[i] + nodes->fy[i] * nodes->v[i];
    }
  }
  return sum;
}

class ViscousKernel : public testing::TestWithParam<const Kernels*> {};

// s = rho l (b_1 c_d d + b_2^2 l |d| min(0, d)), l = 1 mm, and forces whose power is -s d per volume.
TEST_P(ViscousKernel, StressAndForcesAreTheClosedForm) {
  for (const Measure& measure : {Measure{PlaneStrain{1e-3}}, Measure{Axisymmetric{}}}) {
    const double hoops = is_of_revolution(measure) ? 1.0 : 0.0;
    for (const int columns : {1, 8, 11}) {
      for (const double squeeze : {-3e4, 2e4}) {
        Body body = block(columns, kFactors, measure, *GetParam());
        Body plain = block(columns, {}, measure, *GetParam());
        grow(body, squeeze, 0.4 * squeeze);
        grow(plain, squeeze, 0.4 * squeeze);
        const double rate = (1.4 + hoops) * squeeze;
        double expected_power = 0.0;
        for (int row = 0; row < body.mesh().row_count(); ++row) {
          const Elastic& law = elastic_part(body.material(row));
          const double speed = std::sqrt(law.longitudinal_modulus() / law.density);
          const double stress =
              law.density * 1e-3 * (0.06 * speed * rate + 1.44 * 1e-3 * std::abs(rate) * std::min(0.0, rate));
          for (int column = 0; column < columns; ++column) {
            EXPECT_NEAR(body.viscous_stress(row, column), stress, 1e-6 * std::abs(stress));
            const double x = body.mesh().corner_x(column) + 0.5e-3;
            expected_power -= stress * rate * 1e-6 * thickness(measure, x);
          }
        }
        EXPECT_NEAR(power(body) - power(plain), expected_power, 1e-6 * std::abs(expected_power));
      }
    }
  }
}

TEST_P(ViscousKernel, OffIsTheSameBits) {
  Body off = block(11, {}, PlaneStrain{1e-3}, *GetParam());
  Body none = block(11, {}, PlaneStrain{1e-3}, *GetParam());
  none.resist_volume({.linear = 0.0, .quadratic = 0.0});
  grow(off, -3e4, 1e4);
  grow(none, -3e4, 1e4);
  EXPECT_EQ(off.stable_step(), none.stable_step());
  EXPECT_EQ(std::memcmp(off.corners.fx.data(), none.corners.fx.data(), off.corners.fx.size() * sizeof(double)), 0);
}

std::string name_of(const testing::TestParamInfo<const Kernels*>& info) { return info.param->name; }

INSTANTIATE_TEST_SUITE_P(BulkViscosity, ViscousKernel,
                         testing::ValuesIn(available_kernels().begin(), available_kernels().end()), name_of);

/// Random velocities at the start, then free.
void shake(Body& body) {
  std::mt19937 random(7);
  test::for_each_node(body, [&](Nodes& nodes, std::size_t i) {
    nodes.u[i] = static_cast<double>(random()) / std::mt19937::max() - 0.5;
    nodes.v[i] = static_cast<double>(random()) / std::mt19937::max() - 0.5;
  });
}

struct Energies {
  double start = 0.0, end = 0.0, viscous = 0.0, worst = 0.0;  ///< J; worst: change of the sum over its start
};

/// `part`: of the stable step.
Energies shaken(const BulkFactors& factors, const Measure& measure, double step, double duration) {
  Body body = block(12, factors, measure);
  shake(body);
  const auto hold = [](Body& b) {
    for (int row = 0; row <= b.mesh().row_count(); ++row) b.corners.u[b.mesh().corner({row, 0})] = 0.0;
  };
  hold(body);
  Energies found;
  found.start = kinetic_energy(body, Velocities::of(body));
  for (int n = 0; n * step < duration; ++n) {
    const Velocities before = Velocities::of(body);
    body.kick(n == 0 ? 0.5 * step : step);
    hold(body);
    const Velocities at = Velocities::blend(before, Velocities::of(body), n == 0 ? 0.0 : 0.5);
    found.end = conserved_kinetic_energy(body, before, at) + elastic_energy(body);
    found.worst = std::max(found.worst, std::abs((found.end + found.viscous) / found.start - 1.0));
    body.drift(step);
    found.viscous += body.sweep(step).viscous_work;
  }
  return found;
}

// What motion loses is what is booked, at any step: the work is the trapezoidal one of central differences.
TEST(BulkViscosity, ItsWorkClosesTheLedger) {
  for (const Measure& measure : {Measure{PlaneStrain{1e-3}}, Measure{Axisymmetric{}}}) {
    const double step = 0.5 * block(12, kFactors, measure).stable_step();
    const Energies found = shaken(kFactors, measure, step, 400 * step);
    EXPECT_GT(found.viscous, 0.2 * found.start);
    EXPECT_LT(found.worst, 3e-5);  // strains of 1e-4: the floor of the elastic energy (docs/theory/structure.md)
  }
}

// The backend books it: without, the report would miss what is counted here.
TEST(BulkViscosity, IsReportedAsViscous) {
  scene::Structure part = test::beam(scene::Layer::MATERIAL_DH36, 0.1, 0.02, 3);
  part.mutable_bulk_viscosity()->set_linear(0.06);
  part.mutable_bulk_viscosity()->set_quadratic(1.2);
  Structure structure;
  const wire::Ready ready = structure.prepare(test::setup_of(part));
  wire::Start start;
  start.set_window(0.5 * ready.stable_step());
  start.set_windows(1000);
  start.set_impactor_steps(1);
  start.set_structure_steps(1);
  structure.start(start);
  wire::Report report;
  for (std::uint64_t n = 0; n <= 300; ++n) {
    wire::Forces forces;
    forces.set_window(n);
    for (int k = 0; k < ready.surface().position_size() / 2; ++k) {
      forces.add_impulse(0.0);
      forces.add_impulse(n < 20 ? -2e-4 : 0.0);  // 1 GPa, all at once
    }
    wire::Kinematics next;
    structure.advance(forces, {.report = n == 300, .snapshot = false}, next);
    if (n == 300) structure.report(report);
    structure.complete();
  }
  const wire::Energy& energy = report.energy();
  const double sum = energy.kinetic() + energy.elastic() + energy.plastic() + energy.viscous();
  EXPECT_GT(energy.plastic(), 0.0);
  EXPECT_GT(energy.viscous(), 0.05 * energy.interface_work());
  EXPECT_NEAR(sum, energy.interface_work(), 2e-3 * energy.interface_work());  // elastic strains of 0.5%
}

// 2/omega (sqrt(1 + xi^2) - xi): stable up to it, and no more at the step of the undamped body where damping is strong.
TEST(BulkViscosity, ShortensTheStableStep) {
  constexpr BulkFactors strong{.linear = 0.5, .quadratic = 1.2};
  for (const Measure& measure : {Measure{PlaneStrain{1e-3}}, Measure{Axisymmetric{}}}) {
    const double undamped = block(12, {}, measure).stable_step();
    const double limit = block(12, strong, measure).stable_step();
    EXPECT_LT(limit, 0.5 * undamped);
    EXPECT_GT(block(12, kFactors, measure).stable_step(), 0.8 * undamped);
    const Energies stable = shaken(strong, measure, limit, 2000 * limit);
    EXPECT_LT(std::abs(stable.end), stable.start);
    const Energies grown = shaken(strong, measure, undamped, 12 * undamped);
    EXPECT_GT(std::abs(grown.end), 10.0 * grown.start);  // its kinetic part changes sign with every step
  }
}

}  // namespace
}  // namespace grainstep::fe
