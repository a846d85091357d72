/// @file What the loader says about broken scenes, word by word: the messages are its user interface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(LoadErrors, UnknownKeyWithHint) {
  EXPECT_EQ(
      load_error(replaced(minimal_scene, "      restitution: 0.7", "      restitution: 0.7\n      diametre: 1 mm")),
      "x.yaml:13: impactor.slug.particle.diametre: unknown key; did you mean 'diameter'? Known keys here: diameter, "
      "density, normal_stiffness, tangential_ratio, restitution, friction");
  EXPECT_THAT(load_error(minimal_scene + "wholly_unlike: 1\n"),
              StartsWith("x.yaml:17: wholly_unlike: unknown key. Known keys here: title, symmetry"));
}

TEST(LoadErrors, WrongUnit) {
  EXPECT_EQ(load_error(replaced(minimal_scene, "200 um", "200 um/s")),
            "x.yaml:9: impactor.slug.particle.diameter: '200 um/s' is a speed and cannot be converted to m");
  EXPECT_EQ(load_error(minimal_scene, {"impactor.slug.particle.friction=0.7 m"}),
            "--set: impactor.slug.particle.friction: '0.7 m' is a length and cannot be converted to a pure number");
}

TEST(LoadErrors, OutOfRange) {
  EXPECT_EQ(load_error(replaced(minimal_scene, "2700 kg/m^3", "-2700 kg/m^3")),
            "x.yaml:10: impactor.slug.particle.density: '-2700 kg/m^3' is out of range: it must be above 0 kg/m^3");
  EXPECT_EQ(load_error(replaced(minimal_scene, "restitution: 0.7", "restitution: 1.5")),
            "x.yaml:12: impactor.slug.particle.restitution: '1.5' is out of range: it must be above 0, at most 1");
}

TEST(LoadErrors, MissingKey) {
  EXPECT_EQ(load_error(replaced(minimal_scene, "    speed: 400 m/s\n", "")),
            "x.yaml:3: impactor.slug: required key 'speed' is missing: Speed towards the structure. Expected a number "
            "with a unit of m/s");
  EXPECT_THAT(load_error(""), StartsWith("x.yaml: required key 'time' is missing"));
}

TEST(LoadErrors, WrongKindOfValue) {
  EXPECT_EQ(load_error(minimal_scene, {"impactor.slug.speed=fast"}),
            "--set: impactor.slug.speed: 'fast' is not a number; expected a number with a unit of m/s");
  EXPECT_EQ(load_error(minimal_scene, {"impactor.slug.speed=[1, 2]"}),
            "--set: impactor.slug.speed: expected a number with a unit of m/s, found a list");
  EXPECT_EQ(load_error(minimal_scene, {"impactor.slug.speed="}),
            "--set: impactor.slug.speed: this key has no value; expected a number with a unit of m/s");
  EXPECT_EQ(load_error(minimal_scene, {"structure.mesh=15"}),
            "--set: structure.mesh: expected a map of keys (refinement), found '15'");
  EXPECT_EQ(load_error(minimal_scene, {"structure.layers={material: dh36}"}).substr(0, 74),
            "--set: structure.layers: expected a list, found a map of keys");
  EXPECT_EQ(load_error(minimal_scene, {"output.snapshots=2.5"}),
            "--set: output.snapshots: '2.5' is not a whole number");
  EXPECT_EQ(load_error(minimal_scene, {"output.snapshots=-1"}), "--set: output.snapshots: '-1' is not a whole number");
  EXPECT_EQ(load_error(minimal_scene, {"output.snapshots=99999999999"}),
            "--set: output.snapshots: '99999999999' is too large");
  EXPECT_EQ(load_error(minimal_scene, {"impactor.slug.surface_contact.tension_cutoff=maybe"}),
            "--set: impactor.slug.surface_contact.tension_cutoff: 'maybe' is not true or false");
}

TEST(LoadErrors, UnknownWord) {
  EXPECT_EQ(load_error(replaced(minimal_scene, "dh36", "dh63")),
            "x.yaml:16: structure.layers.0.material: 'dh63' is not one of dh36, elastic, core; did you mean 'dh36'?");
  EXPECT_THAT(load_error(minimal_scene, {"structure.type=unset"}), HasSubstr("is not one of beam, rigid, external"));
}

TEST(LoadErrors, ABareEndNeedsALayerThatYields) {
  EXPECT_THAT(
      load_error(minimal_scene, {"structure.layers.0.material=elastic", "steps.structure=10 ns"}),
      HasSubstr("x.yaml:1: time.end: found 1.5, and a bare number counts L sqrt(rho_m/sigma_Y), but no layer of "
                "this structure yields: there is no sigma_Y. Write seconds, with their unit"));
}

TEST(LoadErrors, AScalarThatFitsNoAlternative) {
  EXPECT_EQ(
      load_error(minimal_scene, {"steps.impactor=autp"}),
      "--set: steps.impactor: 'autp' is not auto (chosen from the stable steps), or a number with a unit of s (a "
      "fixed step), or a pure number (impactor: contact time over step (auto: 10); structure: structure step over "
      "impactor step); did you mean 'auto'?");
  EXPECT_EQ(load_error(minimal_scene, {"time.end=3 mm"}),
            "--set: time.end: '3 mm' is a length and cannot be converted to s");
  EXPECT_EQ(load_error(minimal_scene, {"time.end=-1"}), "--set: time.end: '-1' is out of range: it must be above 0");
  EXPECT_THAT(load_error(minimal_scene, {"time.end={t_bar: 1}"}), HasSubstr("found a map of keys"));
}

TEST(LoadErrors, EmptyList) {
  EXPECT_EQ(load_error(minimal_scene, {"structure.layers=[]"}),
            "--set: structure.layers: a list of 0; it needs at least 1");
}

TEST(LoadErrors, AllProblemsAtOnceOneLineEach) {
  const std::string broken = replaced(replaced(minimal_scene, "200 um", "tiny"), "dh36", "butter") + "extra: 1\n";
  EXPECT_EQ(load_error(broken),
            "x.yaml:17: extra: unknown key. Known keys here: title, symmetry, depth, time, impactor, structure, steps, "
            "guards, output\n"
            "x.yaml:9: impactor.slug.particle.diameter: 'tiny' is not a number; expected a number with a unit of m\n"
            "x.yaml:16: structure.layers.0.material: 'butter' is not one of dh36, elastic, core");
}

TEST(LoadErrors, DuplicateKeys) {
  EXPECT_EQ(load_error(replaced(minimal_scene, "    speed: 400 m/s\n", "    speed: 400 m/s\n    speed: 300 m/s\n")),
            "x.yaml:8: impactor.slug.speed: this key is already given in line 7");
}

TEST(LoadErrors, NotYaml) {
  EXPECT_THAT(load_error("time: { end: 1.5\nimpactor: [\n"), StartsWith("x.yaml:"));
  EXPECT_THAT(load_error("time: { end: 1.5\nimpactor: [\n"), HasSubstr("not YAML: "));
  EXPECT_EQ(load_error("- a\n- b\n"), "x.yaml: expected a map of keys at the top level, found a list");
  EXPECT_EQ(load_error("just words"), "x.yaml: expected a map of keys at the top level, found 'just words'");
  EXPECT_EQ(load_error("a: 1\n---\nb: 2\n"), "x.yaml:2: more than one YAML document (---); expected one");
  EXPECT_EQ(load_error(std::string("time: 1\n\0", 9)),
            "x.yaml:2: a control character (byte 0); expected YAML text in UTF-8");
  EXPECT_THAT(load_error("? [a, b]\n: c\n"), HasSubstr("a key must be a name"));
  EXPECT_EQ(load_error("title: \"\xff\xfe\"\n" + minimal_scene),
            "x.yaml:1: not UTF-8 (invalid leading UTF-8 octet); expected YAML text in UTF-8");
}

TEST(LoadErrors, TooMuch) {
  EXPECT_THAT(load_error(std::string(300000, '#')), HasSubstr("300000 bytes; a scene has at most 262144"));
  EXPECT_THAT(load_error(std::string("a: ").append(100, '[').append(100, ']')), HasSubstr("more than 32 levels"));
  EXPECT_THAT(load_error(std::string("a: ").append(100000, '[')), HasSubstr("x.yaml:1: "));
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = std::string("*a").append(std::to_string(i - 1));
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + before;
    for (int k = 0; k < 9; ++k) bomb += ", " + before;
    bomb += "]\n";
  }
  EXPECT_THAT(load_error(bomb), HasSubstr("too large once its aliases are written out"));
  EXPECT_THAT(load_error("a: &x [ *x ]\n"), HasSubstr("an alias inside of what it stands for"));
}

TEST(LoadErrors, AHandfulOfLinesForAThousandProblems) {
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "key" + std::to_string(i) + ": 1\n";
  EXPECT_THAT(load_error(many + minimal_scene), HasSubstr("\nand 950 more"));
}

TEST(LoadErrors, QuotedInputCannotBreakTheLine) {
  EXPECT_EQ(load_error(minimal_scene, {"impactor.slug.speed=\"a\\nb\\e[2J\""}),
            "--set: impactor.slug.speed: 'a b [2J' is not a number; expected a number with a unit of m/s");
}

}  // namespace
}  // namespace grainstep::scene
