/// @file Every scene under configs/ does what its header says: valid ones load, broken ones are refused with the
/// message of their `# expect:` line. Those of another `# stage:` than the loader's only load here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "scene/groups.hpp"
#include "scene/usual.hpp"
#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

namespace fs = std::filesystem;

const fs::path configs = fs::path(GRAINSTEP_SOURCE_DIR) / "configs";

std::vector<fs::path> scenes(bool invalid) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(configs)) {
    const bool is_invalid = entry.path().parent_path().filename() == "invalid";
    if (entry.path().string().starts_with((configs / "studies").string()))
      continue;  // orchestrator/study's tests load those
    if (entry.path().extension() == ".yaml" && is_invalid == invalid) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// What follows `label` in a comment of the file; empty if it has none.
std::string header_line(const fs::path& path, const std::string& label) {
  std::istringstream lines(text_of(path));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(label)) return line.substr(label.size());
  }
  return {};
}

TEST(Configs, ValidScenesLoadAndNameTheirOrigin) {
  const auto all = scenes(false);
  EXPECT_GE(all.size(), 4);
  for (const auto& path : all) {
    EXPECT_NO_THROW(static_cast<void>(load_scene(path))) << path;
    for (const auto* const label :
         {"# yaml-language-server: $schema=", "# Figure ", "# Source ", "# Formula ", "# Expected "}) {
      EXPECT_NE(header_line(path, label), "") << path << ": no line '" << label << "'";
    }
    const fs::path schema = path.parent_path() / header_line(path, "# yaml-language-server: $schema=");
    EXPECT_TRUE(fs::exists(schema)) << schema;
  }
}

// configs/hard is what lies beyond.
TEST(Configs, ValidScenesHoldUsualValues) {
  for (const auto& path : scenes(false)) {
    if (path.parent_path().filename() == "hard") continue;
    std::vector<Finding> findings;
    check_usual(load_scene(path), findings);
    for (const Finding& finding : findings) ADD_FAILURE() << path << ": " << finding.path << ": " << finding.text;
  }
}

TEST(Configs, TheReferenceBeamIsThePapers) {
  const Scene scene = load_scene(configs / "liu2013" / "beam-monolithic.yaml");
  EXPECT_NEAR(groups(scene).impulse_number, 0.67, 0.005);
  EXPECT_DOUBLE_EQ(scene.impactor().slug().particle().diameter(), 200e-6);
  EXPECT_EQ(scene.structure().mesh().refinement(), 15);
}

// Its H in millimetres wins over its m_bar; the head of the scene says how to get the other reading.
TEST(Configs, TheReferencePlateHasBothReadings) {
  for (const auto* const folder : {"liu2013", "small"}) {
    const auto path = configs / folder / "plate-monolithic.yaml";
    const Groups stated = groups(load_scene(path));
    EXPECT_NEAR(stated.impulse_number, 0.67, 0.001);
    EXPECT_NEAR(stated.areal_mass_ratio, 0.506, 0.0005);
    const std::vector<std::string> shorter = {"impactor.slug.height=120mm", "impactor.slug.speed=401m/s"};
    const Groups other = groups(load_scene(path, shorter));
    EXPECT_NEAR(other.impulse_number, 0.67, 0.001);
    EXPECT_NEAR(other.areal_mass_ratio, 0.405, 1e-12);
  }
}

// (3.2) and (5.2), and the viscosity of (3.10) from the slug's speed unless the scene gives one.
TEST(Configs, TheSandwichBeamsAreThePapers) {
  for (const auto& [name, thickness] :
       {std::pair{"beam-sandwich-c011.yaml", 0.055}, {"beam-sandwich-c033.yaml", 0.165}}) {
    for (const auto* const folder : {"liu2013", "small"}) {
      const Scene scene = load_scene(configs / folder / name);
      EXPECT_NEAR(groups(scene).impulse_number, 0.67, 0.005);
      ASSERT_EQ(scene.structure().layers_size(), 3);
      for (const Layer& layer : scene.structure().layers()) {
        EXPECT_NEAR(layer.density() * layer.thickness(), 400.0 / 3.0, 1e-6);
      }
      const Layer& core = scene.structure().layers(1);
      EXPECT_DOUBLE_EQ(core.thickness(), thickness);
      const double densification = 1.0 - 1.5 * core.density() / 8000.0;
      EXPECT_NEAR(core.viscosity(), 0.1 * thickness * core.density() * 400.0 / densification, 1e-6);
    }
  }
  const std::vector<std::string> given = {"structure.layers.1.viscosity=0 Pa.s", "impactor.slug.speed=100 m/s"};
  EXPECT_EQ(load_scene(configs / "small/beam-sandwich-c011.yaml", given).structure().layers(1).viscosity(), 0.0);
}

TEST(Configs, BrokenScenesAreRefusedWithTheirMessage) {
  const auto all = scenes(true);
  EXPECT_GE(all.size(), 14);
  for (const auto& path : all) {
    const std::string expected = header_line(path, "# expect: ");
    ASSERT_NE(expected, "") << path << ": no line '# expect: '";
    if (const std::string stage = header_line(path, "# stage: "); !stage.empty()) {
      EXPECT_NO_THROW(static_cast<void>(load_scene(path))) << path << " is for the stage " << stage;
      continue;
    }
    try {
      static_cast<void>(load_scene(path));
      ADD_FAILURE() << path << " is accepted";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_THAT(text, testing::HasSubstr(expected)) << path;
      EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 0) << path << " has more than one problem:\n" << text;
    }
  }
}

}  // namespace
}  // namespace grainstep::scene
