#include "fe-service/mesh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "../../support/fe_scenes.hpp"
#include "base/error.hpp"

namespace grainstep::fe {
namespace {

using test::beam;
using testing::HasSubstr;

TEST(Mesh, ReferenceBeamHasTheElementCountOfItsRefinement) {
  const Mesh coarse = make_mesh(beam(scene::Layer::MATERIAL_DH36, 0.5, 0.05, 8));
  EXPECT_EQ(coarse.columns, 160);
  EXPECT_EQ(coarse.row_count(), 16);
  EXPECT_EQ(coarse.triangles(), 10240u);
  const Mesh fine = make_mesh(beam(scene::Layer::MATERIAL_DH36, 0.5, 0.05, 15));
  EXPECT_EQ(fine.triangles(), 36000u);
}

TEST(Mesh, MeetsSpanAndThicknessExactlyWithUnevenRatios) {
  const Mesh mesh = make_mesh(beam(scene::Layer::MATERIAL_DH36, 0.5, 0.047, 3.3));
  EXPECT_EQ(mesh.corner_x(0), 0.0);
  EXPECT_EQ(mesh.corner_x(mesh.columns), 0.5);
  EXPECT_EQ(mesh.level.front(), 0.0);
  EXPECT_EQ(mesh.level.back(), -0.047);
  EXPECT_LE(mesh.width, mesh.element_size * (1.0 + 1e-9));
  EXPECT_LE(mesh.rows[0].height, mesh.element_size * (1.0 + 1e-9));
}

TEST(Mesh, LayersKeepTheirThicknessAndOrder) {
  scene::Structure structure = beam(scene::Layer::MATERIAL_DH36, 0.1, 0.004, 2);
  *structure.add_layers() = test::steel(scene::Layer::MATERIAL_ELASTIC, 0.011);
  *structure.add_layers() = test::steel(scene::Layer::MATERIAL_DH36, 0.004);
  const Mesh mesh = make_mesh(structure);
  double thickness[3] = {};
  for (const ElementRow& row : mesh.rows) thickness[row.layer] += row.height;
  EXPECT_NEAR(thickness[0], 0.004, 1e-15);
  EXPECT_NEAR(thickness[1], 0.011, 1e-15);
  EXPECT_NEAR(thickness[2], 0.004, 1e-15);
  EXPECT_EQ(mesh.rows.front().layer, 0);
  EXPECT_EQ(mesh.rows.back().layer, 2);
}

TEST(Mesh, CoarserThanTheFaceIsRefusedWithTheCure) {
  try {
    (void)make_mesh(beam(scene::Layer::MATERIAL_DH36, 0.5, 0.05, 0.4));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("mesh coarser than the face"));
    EXPECT_THAT(error.what(), HasSubstr("at least 0.5"));
  }
}

TEST(Mesh, AbsurdSizeIsRefused) {
  EXPECT_THROW((void)make_mesh(beam(scene::Layer::MATERIAL_DH36, 0.5, 0.05, 1e5)), InputError);
}

TEST(Mesh, SurfaceOfTheHalfSpanRunsOverTheTopAndDownTheEnd) {
  const Mesh mesh = make_mesh(beam(scene::Layer::MATERIAL_DH36, 0.5, 0.05, 2));
  const std::vector<Corner> chain = mesh.surface();
  ASSERT_EQ(chain.size(), static_cast<std::size_t>(mesh.columns + 1 + mesh.row_count()));
  EXPECT_EQ(chain.front().column, 0);
  EXPECT_EQ(chain.front().row, 0);
  EXPECT_EQ(chain.back().column, mesh.columns);
  EXPECT_EQ(chain.back().row, mesh.row_count());
}

TEST(Mesh, FullSpanIsSymmetricAndHasACornerAtMidSpan) {
  scene::Structure structure = beam(scene::Layer::MATERIAL_DH36, 0.5, 0.05, 3);
  structure.set_extent(scene::Structure::EXTENT_FULL);
  const Mesh mesh = make_mesh(structure);
  EXPECT_EQ(mesh.corner_x(mesh.mid_column), 0.0);
  EXPECT_EQ(mesh.corner_x(0), -0.5);
  const std::vector<Corner> chain = mesh.surface();
  EXPECT_EQ(chain.front().column, 0);
  EXPECT_EQ(chain.front().row, mesh.row_count());
}

}  // namespace
}  // namespace grainstep::fe
