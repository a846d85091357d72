#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

using testing::HasSubstr;

TEST(Include, KeysBelowOverrideAndMapsMergeDeeply) {
  const SceneFiles files;
  files.write("base/base.yaml", minimal_scene);
  const Scene scene = load_scene(files.write("small/x.yaml", R"(include: ../base/base.yaml
impactor: { slug: { particle: { diameter: 1 mm } } }
)"));
  EXPECT_DOUBLE_EQ(scene.impactor().slug().particle().diameter(), 1e-3);
  EXPECT_DOUBLE_EQ(scene.impactor().slug().particle().density(), 2700);
}

TEST(Include, ListsAreReplaced) {
  const SceneFiles files;
  files.write("base.yaml", minimal_scene);
  const Scene scene = load_scene(files.write("x.yaml", R"(include: base.yaml
structure: { layers: [{ material: dh36, thickness: 1 mm }, { material: elastic, thickness: 2 mm }] }
)"));
  ASSERT_EQ(scene.structure().layers_size(), 2);
  EXPECT_DOUBLE_EQ(scene.structure().layers(1).thickness(), 2e-3);
}

TEST(Include, SeveralInOrderAndNested) {
  const SceneFiles files;
  files.write("base.yaml", minimal_scene);
  files.write("fast.yaml", "include: base.yaml\nimpactor: { slug: { speed: 500, seed: 5 } }\n");
  files.write("other.yaml", "impactor: { slug: { seed: 6 } }\n");
  const Scene scene = load_scene(files.write("x.yaml", "include: [fast.yaml, other.yaml]\ntitle: both\n"));
  EXPECT_EQ(scene.impactor().slug().speed(), 500);
  EXPECT_EQ(scene.impactor().slug().seed(), 6);
}

TEST(Include, ErrorsNameTheFileThatSaysIt) {
  const SceneFiles files;
  files.write("base/base.yaml", replaced(minimal_scene, "200 um", "200 s"));
  const auto path = files.write("small/x.yaml", "include: ../base/base.yaml\ntitel: typo\n");
  const std::string error = load_error(files, path);
  EXPECT_THAT(error, HasSubstr("small/x.yaml:2: titel: unknown key; did you mean 'title'?"));
  EXPECT_THAT(error, HasSubstr("base/base.yaml:9: impactor.slug.particle.diameter: '200 s' is a time"));
}

TEST(Include, CyclesAreRefused) {
  const SceneFiles files;
  files.write("a.yaml", "include: b.yaml\n");
  files.write("b.yaml", "\ninclude: ./../" + files.folder().filename().string() + "/a.yaml\n");
  EXPECT_EQ(load_error(files, files.folder() / "a.yaml"),
            "b.yaml:2: include: 'a.yaml' includes itself (by way of 2 files)");
}

TEST(Include, MissingOrOddFiles) {
  const SceneFiles files;
  EXPECT_EQ(load_error(files, files.write("x.yaml", "include: nowhere.yaml\n")),
            "x.yaml:1: include: cannot read 'nowhere.yaml': no such file");
  EXPECT_EQ(load_error(files, files.write("x.yaml", "include: .\n")).substr(0, 30), "x.yaml:1: include: cannot read");
  EXPECT_EQ(load_error(files, files.write("x.yaml", "include: { a: 1 }\n")),
            "x.yaml:1: include: expected a path or a list of paths, found a map of keys");
  EXPECT_EQ(load_error(files, files.folder() / "absent.yaml"), "absent.yaml: cannot read 'absent.yaml': no such file");
  EXPECT_THAT(load_error(files, files.write("x.yaml", minimal_scene + "output: { include: y.yaml }\n")),
              HasSubstr("a file is included at its top level only"));
}

TEST(Include, ManyFilesThatIncludeTwoOthers) {
  const SceneFiles files;
  files.write("0.yaml", minimal_scene);
  for (int i = 1; i < 30; ++i) {
    std::ostringstream text;
    text << "include: [" << i - 1 << ".yaml, " << i - 1 << ".yaml]\n";
    files.write(std::to_string(i) + ".yaml", text.str());
  }
  EXPECT_THAT(load_error(files, files.folder() / "29.yaml"), HasSubstr("more than 64 included files"));
}

}  // namespace
}  // namespace grainstep::scene
