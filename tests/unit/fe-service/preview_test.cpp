// What is told of a structure without computing it.
#include "fe-service/preview.hpp"

#include <gtest/gtest.h>

#include "../../support/fe_scenes.hpp"
#include "base/error.hpp"
#include "fe-service/structure.hpp"

namespace grainstep::fe {
namespace {

using test::setup_of;

const scene::Structure kSmallBeam = test::beam(scene::Layer::MATERIAL_DH36, 0.1, 0.02, 3);

TEST(Preview, AgreesWithTheModelItDescribes) {
  const wire::Ready ready = Structure().prepare(setup_of(kSmallBeam));
  const StructurePreview found = preview(kSmallBeam, scene::SYMMETRY_PLANE_STRAIN, 1e-3);
  EXPECT_EQ(found.elements, ready.size());
  EXPECT_NEAR(found.stable_step, ready.stable_step(), 1e-12 * ready.stable_step());
  EXPECT_NEAR(found.preferred_step, ready.preferred_step(), 1e-12 * ready.stable_step());
  EXPECT_EQ(found.areal_mass, 160.0);
  EXPECT_EQ(found.memory_bytes, ready.memory());
}

// The plan that `check` shows is made with these; a run makes its own with the model's.
TEST(Preview, KnowsTheMassOfASurfaceNodeAndTheSurface) {
  for (const auto extent : {scene::Structure::EXTENT_HALF, scene::Structure::EXTENT_FULL}) {
    scene::Structure beam = kSmallBeam;
    beam.set_extent(extent);
    wire::Setup setup = setup_of(beam);
    const wire::Ready built = Structure().prepare(setup);
    setup.set_preview(true);
    const wire::Ready asked = Structure().prepare(setup);
    EXPECT_NEAR(asked.contact_mass() / built.contact_mass(), 1.0, 1e-12);
    EXPECT_EQ(asked.surface().facet_size(), built.surface().facet_size());
    ASSERT_EQ(asked.surface().position_size(), built.surface().position_size());
    for (int i = 0; i < built.surface().position_size(); ++i) {
      EXPECT_NEAR(asked.surface().position(i), built.surface().position(i), 1e-15);
    }
  }
}

TEST(Preview, RefusesWhatCannotBeComputed) {
  scene::Structure coarse = kSmallBeam;
  coarse.mutable_mesh()->set_refinement(0.1);
  EXPECT_THROW((void)preview(coarse, scene::SYMMETRY_PLANE_STRAIN, 1e-3), InputError);
}

}  // namespace
}  // namespace grainstep::fe
