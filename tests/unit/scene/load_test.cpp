#include "scene/load.hpp"

#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <set>

#include "declare/write.hpp"
#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

using google::protobuf::util::MessageDifferencer;

TEST(Load, ConvertsToSi) {
  const Scene scene = load_text(minimal_scene);
  const auto& particle = scene.impactor().slug().particle();
  EXPECT_DOUBLE_EQ(particle.diameter(), 200e-6);
  EXPECT_DOUBLE_EQ(particle.normal_stiffness(), 7.3e6);
  EXPECT_DOUBLE_EQ(scene.structure().layers(0).thickness(), 0.05);
  EXPECT_EQ(scene.structure().layers(0).material(), Layer::MATERIAL_DH36);
}

TEST(Load, FillsInDefaultsAtEveryLevel) {
  const Scene scene = load_text(minimal_scene);
  EXPECT_EQ(scene.symmetry(), SYMMETRY_PLANE_STRAIN);
  EXPECT_DOUBLE_EQ(scene.depth(), 1e-3);
  EXPECT_EQ(scene.impactor().type(), Impactor::TYPE_SLUG);
  EXPECT_EQ(scene.impactor().slug().seed(), 1);
  EXPECT_DOUBLE_EQ(scene.impactor().slug().particle().tangential_ratio(), 2.0 / 7.0);
  EXPECT_EQ(scene.structure().mesh().refinement(), 8);
  EXPECT_EQ(scene.structure().layers(0).young(), 200e9);
  EXPECT_EQ(scene.steps().impactor().automatic(), Step::AUTO_AUTO);
  EXPECT_EQ(scene.guards().momentum_error(), 1e-9);
  EXPECT_EQ(scene.output().snapshots(), 50);
}

TEST(Load, LeavesOptionalKeysUnset) {
  EXPECT_FALSE(load_text(minimal_scene).impactor().slug().surface_contact().has_restitution());
  const Scene scene = load_text(minimal_scene, {"impactor.slug.surface_contact={restitution: 0.5}"});
  EXPECT_TRUE(scene.impactor().slug().surface_contact().has_restitution());
  EXPECT_FALSE(scene.impactor().slug().surface_contact().has_friction());
}

TEST(Load, AScalarPicksTheAlternativeThatFitsIt) {
  EXPECT_EQ(load_text(minimal_scene).time().end().t_bar(), 1.5);
  EXPECT_DOUBLE_EQ(load_text(minimal_scene, {"time.end=3 ms"}).time().end().seconds(), 3e-3);
  EXPECT_DOUBLE_EQ(load_text(minimal_scene, {"steps.impactor=24 ns"}).steps().impactor().seconds(), 24e-9);
  EXPECT_EQ(load_text(minimal_scene, {"steps.structure=4"}).steps().structure().ratio(), 4);
  EXPECT_EQ(load_text(minimal_scene, {"steps.structure=auto"}).steps().structure().automatic(), Step::AUTO_AUTO);
}

TEST(Load, AliasesAreWrittenOut) {
  const std::string two = replaced(minimal_scene, "- { material: dh36, thickness: 50 mm }",
                                   "- &face { material: dh36, thickness: 20 mm }\n    - *face");
  const Scene scene = load_text(two);
  ASSERT_EQ(scene.structure().layers_size(), 2);
  EXPECT_TRUE(MessageDifferencer::Equals(scene.structure().layers(0), scene.structure().layers(1)));
}

TEST(Load, LeavesTheMessageAloneOnError) {
  const SceneFiles files;
  Scene scene;
  scene.set_title("kept");
  EXPECT_THROW(load(files.write("x.yaml", "title: new"), {}, scene), InputError);
  EXPECT_EQ(scene.title(), "kept");
}

TEST(Load, ReadsAnyDeclaredMessage) {
  const SceneFiles files;
  Particle particle;
  load(files.write("p.yaml", "{diameter: 1 mm, density: 2.7 g/cm3, normal_stiffness: 1e6, restitution: 1}"), {},
       particle);
  EXPECT_DOUBLE_EQ(particle.density(), 2700);
}

TEST(ToYaml, ReadsBackAsTheSameScene) {
  const std::vector<std::vector<std::string>> variants{
      {},
      {"time.end=3.3 ms", "steps.impactor=24.1 ns", "steps.structure=0.5"},
      {"impactor.slug.surface_contact={restitution: 0.3333333333333333, friction: 0, lever_arm: radius}"},
      {"structure.layers.1={material: elastic, thickness: 3.3 mm}",
       "title=\"\\u00b5: a \\\"quoted\\\", #line\\n\\x7f\""},
      {"title=\"\\x7f\\x80\\x85\\x9f\\xa0 \\u2028\\u2029\\ufeff\\ufffe\\uffff\\ud7ff\\U0001f600\\0\\e\""},
      {"impactor.slug.seed=18446744073709551615", "guards.momentum_error=1e-300", "structure.extent=full"}};
  for (const auto& overrides : variants) {
    const Scene scene = load_text(minimal_scene, overrides);
    const std::string text = declare::to_yaml(scene);
    const Scene again = load_text(text);
    EXPECT_TRUE(MessageDifferencer::Equals(scene, again)) << text;
    EXPECT_EQ(text, declare::to_yaml(again));
    EXPECT_EQ(scene_hash(scene), scene_hash(again));
  }
}

TEST(ToYaml, WritesUnits) {
  const std::string text = declare::to_yaml(load_text(minimal_scene));
  EXPECT_NE(text.find("      diameter: 0.0002 m\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  layers:\n    - material: dh36\n      thickness: 0.05 m\n"), std::string::npos) << text;
  EXPECT_NE(text.find("steps:\n  impactor: auto\n  structure: auto\n"), std::string::npos) << text;
}

TEST(SceneHash, SeesEveryValueAndNoSpelling) {
  const auto reference = scene_hash(load_text(minimal_scene));
  EXPECT_EQ(scene_hash(load_text(replaced(minimal_scene, "0.1 m", "100 mm"))), reference);
  EXPECT_EQ(scene_hash(load_text("# a comment\n" + minimal_scene)), reference);
  EXPECT_NE(scene_hash(load_text(minimal_scene, {"impactor.slug.seed=2"})), reference);
  EXPECT_NE(scene_hash(load_text(minimal_scene, {"impactor.slug.speed=400.0000000001"})), reference);
}

TEST(EssenceHash, TitlesAndDefaultsDoNotMatter) {
  const auto plain = essence_hash(load_text(minimal_scene));
  EXPECT_EQ(plain, essence_hash(load_text(minimal_scene, {"title=another"})));
  EXPECT_EQ(plain, essence_hash(load_text(minimal_scene, {"impactor.slug.seed=1", "steps={impactor: auto}",
                                                          "structure.layers.0.density=8 g/cm3", "guards={}"})));
  EXPECT_NE(load_text(minimal_scene, {"title=another"}).title(), "");
}

TEST(EssenceHash, EverythingElseDoes) {
  const auto plain = essence_hash(load_text(minimal_scene));
  for (const char* change :
       {"impactor.slug.seed=2", "steps.impactor=20", "steps.structure=1", "time.end=1 ms",
        "structure.layers.0.density=8.1 g/cm3", "structure.layers.1={material: elastic, thickness: 1 mm}",
        "impactor.slug.surface_contact.friction=0.7", "structure.extent=full"}) {
    EXPECT_NE(plain, essence_hash(load_text(minimal_scene, {change}))) << change;
  }
}

// Protobuf writes no 0, whatever the default is.
TEST(EssenceHash, ZeroIsNotADefaultThatIsNotZero) {
  std::set<std::uint64_t> seen = {essence_hash(load_text(minimal_scene))};
  for (const char* change :
       {"impactor.slug.particle.friction=0", "impactor.slug.seed=0", "structure.layers.0.rate_factor=0",
        "structure.core.shock_width=0", "output.snapshots=0", "output.profiles=0"}) {
    EXPECT_TRUE(seen.insert(essence_hash(load_text(minimal_scene, {change}))).second) << change;
  }
}

// Recorded once: a later version that knows more keys must still recognise the runs of an earlier one.
TEST(EssenceHash, StaysTheSameFromVersionToVersion) {
  EXPECT_EQ(essence_hash(load_text(minimal_scene)), 11215320859481244571U);
}

}  // namespace
}  // namespace grainstep::scene
