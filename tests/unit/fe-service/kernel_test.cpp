// The vector kernel against a plain loop, on every instruction set that this machine has and for every remainder.
#include "fe-service/kernel/kernel.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "../../support/fe_matrices.hpp"
#include "../../support/fe_scenes.hpp"
#include "fe-service/body.hpp"
#include "fe-service/layers.hpp"
#include "reference_loop.hpp"

namespace grainstep::fe {
namespace {

/// Two layers of quads of 1 mm, DH36 on top of elastic.
Body layered_body(int columns, const Kernels& kernels, const Measure& measure = PlaneStrain{1e-3}) {
  scene::Structure structure = test::beam(scene::Layer::MATERIAL_DH36, columns * 1e-3, 2e-3, 2);
  *structure.add_layers() = test::steel(scene::Layer::MATERIAL_ELASTIC, 2e-3);
  return {make_mesh(structure), make_layers(structure), measure, kernels};
}

/// A smooth motion that stretches, shears and turns, differently everywhere.
void prescribe(Body& body, double time) {
  for (Nodes* nodes : {&body.corners, &body.centres}) {
    for (std::size_t i = 0; i < nodes->x.size(); ++i) {
      const double x = nodes->x0[i];
      const double y = nodes->y0[i];
      nodes->u[i] = 40.0 * std::sin(300.0 * x + 1.0) + 2e4 * y * std::cos(2e5 * time);
      if (is_of_revolution(body.measure())) nodes->u[i] *= x / (x + 1e-3);  // nothing at the axis
      nodes->v[i] = -60.0 * std::sin(500.0 * x) + 1e4 * y;
    }
  }
}

class EveryKernel : public testing::TestWithParam<std::tuple<const Kernels*, int, Measure>> {};

TEST_P(EveryKernel, AgreesWithThePlainLoop) {
  const auto [kernels, columns, measure] = GetParam();
  Body body = layered_body(columns, *kernels, measure);
  test::ReferenceLoop reference(body);
  const double step = 5e-8;
  double plastic_work = 0.0;
  double reference_work = 0.0;
  for (int n = 0; n < 40; ++n) {
    prescribe(body, n * step);
    body.drift(step);
    plastic_work += body.sweep(step).plastic_work;
    reference.sweep(step);
    reference_work += reference.plastic_work;
  }
  double force_scale = 0.0;
  for (const auto& force : reference.force) force_scale = std::max(force_scale, force.norm());
  // The return's tolerance, 1e-10 of the flow strength and step, and 40 steps.
  for (std::size_t i = 0; i < reference.force.size(); ++i) {
    EXPECT_LT((reference.kernel_force(static_cast<int>(i)) - reference.force[i]).norm(), 4e-9 * force_scale) << i;
  }
  double flowed = 0.0;
  for (const auto& t : reference.triangles) {
    const Stress s = body.stress(t.row, t.column, t.triangle);
    EXPECT_NEAR(s.xx, t.stress(0, 0), 4e-9 * 470e6);
    EXPECT_NEAR(s.yy, t.stress(1, 1), 4e-9 * 470e6);
    EXPECT_NEAR(s.xy, t.stress(0, 1), 4e-9 * 470e6);
    EXPECT_NEAR(s.zz, t.stress(2, 2), 4e-9 * 470e6);
    EXPECT_NEAR(body.plastic_strain(t.row, t.column, t.triangle), t.plastic_strain, 1e-11);
    flowed = std::max(flowed, t.plastic_strain);
  }
  EXPECT_GT(flowed, 1e-3);  // the comparison has seen real flow
  EXPECT_NEAR(plastic_work, reference_work, 1e-8 * reference_work);
}

std::string name_of(const testing::TestParamInfo<std::tuple<const Kernels*, int, Measure>>& info) {
  return std::string(std::get<0>(info.param)->name) + "_" + std::to_string(std::get<1>(info.param)) + "_columns" +
         (is_of_revolution(std::get<2>(info.param)) ? "_of_rings" : "");
}

INSTANTIATE_TEST_SUITE_P(Kernels, EveryKernel,
                         testing::Combine(testing::ValuesIn(available_kernels().begin(), available_kernels().end()),
                                          testing::Values(1, 7, 8, 9, 16, 21),
                                          testing::Values(Measure{PlaneStrain{1e-3}}, Measure{Axisymmetric{}})),
                         name_of);

// A column's result does not depend on how many columns follow it: lanes beyond the end have no effect at all.
TEST(Remainder, PaddingHasNoEffectOnTheOthers) {
  const double step = 5e-8;
  Body shorter = layered_body(13, *available_kernels().front());
  Body longer = layered_body(24, *available_kernels().front());
  for (int n = 0; n < 20; ++n) {
    for (Body* body : {&shorter, &longer}) {
      for (Nodes* nodes : {&body->corners, &body->centres}) {
        for (std::size_t i = 0; i < nodes->x.size(); ++i) nodes->v[i] = 3e4 * nodes->y0[i];
      }
      body->drift(step);
      body->sweep(step);
    }
  }
  for (int row = 0; row < shorter.mesh().row_count(); ++row) {
    for (int column = 0; column < 13; ++column) {
      for (int t = 0; t < kQuadTriangles; ++t) {
        EXPECT_NEAR(shorter.stress(row, column, t).yy, longer.stress(row, column, t).yy, 1e-3);
        EXPECT_NEAR(shorter.plastic_strain(row, column, t), longer.plastic_strain(row, column, t), 1e-13);
      }
    }
  }
}

TEST(Kernel, SameInputSameBits) {
  const auto run = [] {
    Body body = layered_body(21, *available_kernels().front());
    for (int n = 0; n < 20; ++n) {
      prescribe(body, n * 5e-8);
      body.drift(5e-8);
      body.sweep(5e-8);
    }
    return body;
  };
  const Body first = run();
  const Body second = run();
  const std::size_t bytes = first.corners.fx.size() * sizeof(double);
  EXPECT_EQ(std::memcmp(first.corners.fx.data(), second.corners.fx.data(), bytes), 0);
  EXPECT_EQ(std::memcmp(first.corners.fy.data(), second.corners.fy.data(), bytes), 0);
}

// Without dependence on rate the reference rate means nothing: not even another path to the same root.
TEST(Kernel, WithoutRateFactorTheReferenceRateChangesNoBit) {
  const auto run = [](double reference_rate) {
    scene::Structure structure = test::beam(scene::Layer::MATERIAL_DH36, 21e-3, 2e-3, 2);
    structure.mutable_layers(0)->set_rate_factor(0.0);
    structure.mutable_layers(0)->set_reference_rate(reference_rate);
    Body body(make_mesh(structure), make_layers(structure), PlaneStrain{1e-3});
    for (int n = 0; n < 40; ++n) {
      prescribe(body, n * 5e-8);
      body.drift(5e-8);
      body.sweep(5e-8);
    }
    return body;
  };
  const Body slow = run(1.0);
  for (const double rate : {1e-6, 300.0, 2e3, 1e12}) {
    const Body other = run(rate);
    for (const auto& array : {&Nodes::fx, &Nodes::fy}) {
      EXPECT_EQ(std::memcmp((slow.corners.*array).data(), (other.corners.*array).data(),
                            slow.corners.fx.size() * sizeof(double)),
                0)
          << rate;
    }
  }
}

/// Random displacements of every node by up to `part` of an element's side; those on an axis stay on it.
void distort(Body& body, double part, unsigned seed) {
  std::mt19937 random(seed);
  for (Nodes* nodes : {&body.corners, &body.centres}) {
    for (std::size_t i = 0; i < nodes->x.size(); ++i) {
      const bool held = is_of_revolution(body.measure()) && nodes->x0[i] == 0.0;
      nodes->x[i] += (held ? 0.0 : part * 1e-3) * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0);
      nodes->y[i] += part * 1e-3 * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0);
    }
  }
}

// Never above what the quads' eigenvalues allow, and as near as the tolerance says.
TEST(Kernel, StableStepIsTheSmallestQuads) {
  for (const Kernels* kernels : available_kernels()) {
    for (const double part : {0.0, 0.05, 0.2}) {
      for (const Measure& measure : {Measure{PlaneStrain{1e-3}}, Measure{Axisymmetric{}}}) {
        Body body = layered_body(11, *kernels, measure);
        distort(body, part, 7);
        double smallest = HUGE_VAL;
        for (int row = 0; row < body.mesh().row_count(); ++row) {
          for (int column = 0; column < body.mesh().columns; ++column) {
            const double exact = 2.0 / std::sqrt(test::quad_frequency(body, row, column));
            const double found = body.stable_step(row, column);
            EXPECT_LE(found, exact * (1.0 + 1e-12)) << kernels->name;
            EXPECT_GE(found, exact * (1.0 - 0.5 * kFrequencyTolerance)) << kernels->name;
            smallest = std::min(smallest, exact);
          }
        }
        EXPECT_LE(body.stable_step(), smallest * (1.0 + 1e-12)) << kernels->name;
        EXPECT_GE(body.stable_step(), smallest * (1.0 - 0.5 * kFrequencyTolerance)) << kernels->name;
      }
    }
  }
}

TEST(Kernel, ASquareAllowsAFifthMoreThanItsTriangles) {
  const Body body = layered_body(8, *available_kernels().front());
  const auto nodes = body.triangle(0, 0, 0);
  const Elastic& law = elastic_part(body.material(0));
  const double stiffness = largest_stiffness(law, nodes.a - nodes.centre, nodes.b - nodes.centre);
  const double triangle = 2.0 / std::sqrt(3.0 * stiffness / (law.density * 0.25 * body.mesh().rows[0].quad_area));
  EXPECT_NEAR(body.stable_step() / triangle, 1.22, 0.01);
}

}  // namespace
}  // namespace grainstep::fe
