/// @file No text, however broken, may do anything but load or be refused. Mutated scenes under a fixed seed.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include "declare/write.hpp"
#include "scene_files.hpp"

namespace grainstep::scene {
namespace {

constexpr std::uint32_t seed = 20130501;

class Mutator {
 public:
  std::string mutate(std::string text) {
    const int changes = 1 + pick(3);
    for (int i = 0; i < changes; ++i) change(text);
    return text;
  }

 private:
  int pick(std::size_t count) { return static_cast<int>(random_() % count); }

  void change(std::string& text) {
    static const std::vector<std::string> tokens{":",
                                                 "\n",
                                                 "  ",
                                                 "{",
                                                 "}",
                                                 "[",
                                                 "]",
                                                 "- ",
                                                 "&a ",
                                                 "*a",
                                                 "!!binary ",
                                                 "|\n",
                                                 ">-\n",
                                                 "? ",
                                                 "\"",
                                                 "'",
                                                 "#",
                                                 "---",
                                                 "...",
                                                 "%",
                                                 "<<: ",
                                                 ",",
                                                 "~",
                                                 "null",
                                                 "\t",
                                                 "\r",
                                                 "1e99",
                                                 "-1e999",
                                                 "nan m",
                                                 ".inf",
                                                 "0x1",
                                                 "\xff",
                                                 "\xc3",
                                                 "\x04",
                                                 "@",
                                                 "`",
                                                 "include: x.yaml\n",
                                                 "m^-99999999999",
                                                 "((((((",
                                                 "1 s since 1970-01-01",
                                                 "lg(re 1 mW)",
                                                 "18446744073709551616"};
    const auto at = static_cast<std::size_t>(pick(text.size() + 1));
    const auto length = std::min<std::size_t>(text.size() - at, static_cast<std::size_t>(pick(12)));
    switch (pick(6)) {
      case 0:
        text.insert(at, tokens[static_cast<std::size_t>(pick(tokens.size()))]);
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(static_cast<std::size_t>(pick(text.size() + 1)), text.substr(at, length));
        break;
      case 3:
        if (at < text.size()) text[at] = static_cast<char>(pick(256));
        break;
      case 4:
        text.insert(at, 1, static_cast<char>(pick(256)));
        break;
      default:
        text.replace(at, length, tokens[static_cast<std::size_t>(pick(tokens.size()))]);
    }
  }

  std::mt19937 random_{seed};
};

/// True: loaded. False: refused with a message. Anything else ends the test.
bool loads(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  try {
    const Scene scene = load_scene(path, overrides);
    EXPECT_FALSE(declare::to_yaml(scene).empty());
    return true;
  } catch (const InputError& error) {
    EXPECT_STRNE(error.what(), "");
    return false;
  }
}

TEST(Fuzz, MutatedScenesLoadOrAreRefused) {
  const SceneFiles files;
  Mutator mutator;
  int loaded = 0;
  constexpr int scenes = 4000;
  for (int i = 0; i < scenes; ++i) {
    const std::string text = mutator.mutate(minimal_scene);
    SCOPED_TRACE(text);
    loaded += loads(files.write("x.yaml", text), {}) ? 1 : 0;
  }
  // Both happen, or the mutations are too weak or too strong to test anything.
  EXPECT_GT(loaded, scenes / 100);
  EXPECT_LT(loaded, scenes / 2);
}

TEST(Fuzz, MutatedOverridesApplyOrAreRefused) {
  const SceneFiles files;
  const auto path = files.write("x.yaml", minimal_scene);
  Mutator mutator;
  int loaded = 0;
  constexpr int scenes = 2000;
  for (int i = 0; i < scenes; ++i) {
    const std::string text = mutator.mutate("structure.layers.0.thickness={a: [40 mm, 2]}");
    SCOPED_TRACE(text);
    loaded += loads(path, {"impactor.slug.seed=3", text}) ? 1 : 0;
  }
  EXPECT_LT(loaded, scenes);
}

TEST(Fuzz, ResolvedScenesRoundTripUnderRandomValues) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(-30, 30);
  for (int i = 0; i < 300; ++i) {
    const double value = std::pow(10.0, exponent(random));
    std::ostringstream text;
    text.precision(17);
    text << "structure.half_span=" << value;
    const Scene scene = load_text(minimal_scene, {text.str()});
    EXPECT_EQ(load_text(declare::to_yaml(scene)).structure().half_span(), value);
  }
}

}  // namespace
}  // namespace grainstep::scene
