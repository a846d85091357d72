#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

TEST(Overrides, ReplaceScalarsAndMergeMaps) {
  const Scene scene = load_text(minimal_scene, {"impactor.slug.speed=300 m/s", "impactor.slug={seed: 7}"});
  EXPECT_EQ(scene.impactor().slug().speed(), 300);
  EXPECT_EQ(scene.impactor().slug().seed(), 7);
}

TEST(Overrides, TheLastOneHolds) {
  EXPECT_EQ(load_text(minimal_scene, {"impactor.slug.seed=2", "impactor.slug.seed=3"}).impactor().slug().seed(), 3);
}

TEST(Overrides, ReachListItemsAndAppendOne) {
  const Scene scene = load_text(
      minimal_scene, {"structure.layers.0.thickness=40 mm", "structure.layers.1={material: elastic, thickness: 1 mm}"});
  ASSERT_EQ(scene.structure().layers_size(), 2);
  EXPECT_DOUBLE_EQ(scene.structure().layers(0).thickness(), 0.04);
  EXPECT_EQ(scene.structure().layers(0).material(), Layer::MATERIAL_DH36);
}

TEST(Overrides, MakeWhatIsNotThere) {
  EXPECT_EQ(load_text(minimal_scene, {"output.rows=10"}).output().rows(), 10);
  EXPECT_EQ(load_text(minimal_scene, {"title=a=b"}).title(), "a=b");
}

TEST(Overrides, ErrorsNameThePath) {
  EXPECT_EQ(load_error(minimal_scene, {"structure.layers.3.thickness=1 mm"}),
            "--set: structure.layers.3.thickness: '3' is not an item of this list of 1; its items are counted from 0");
  EXPECT_EQ(load_error(minimal_scene, {"impactor.slug.speed"}),
            "--set: impactor.slug.speed: expected PATH=VALUE, for example impactor.slug.speed='300 m/s'");
  EXPECT_EQ(load_error(minimal_scene, {"impactor..speed=1"}), "--set: impactor..speed: a name is missing in this path");
  EXPECT_EQ(load_error(minimal_scene, {"time.end.t_bar=1"}),
            "--set: time.end.t_bar: what should hold 't_bar' is '1.5'");
  EXPECT_EQ(load_error(minimal_scene, {"include=x.yaml"}), "--set: include: a file is included by a file only");
  EXPECT_THAT(load_error(minimal_scene, {"title=[a"}), testing::HasSubstr("--set: title: --set:1: not YAML: "));
  EXPECT_THAT(load_error(minimal_scene, {"impactor.slug.sped=1"}), testing::HasSubstr("did you mean 'speed'?"));
}

}  // namespace
}  // namespace grainstep::scene
