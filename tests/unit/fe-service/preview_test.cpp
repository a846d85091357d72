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

TEST(Preview, RefusesWhatCannotBeComputed) {
  scene::Structure coarse = kSmallBeam;
  coarse.mutable_mesh()->set_refinement(0.1);
  EXPECT_THROW((void)preview(coarse, scene::SYMMETRY_PLANE_STRAIN, 1e-3), InputError);
}

}  // namespace
}  // namespace grainstep::fe
