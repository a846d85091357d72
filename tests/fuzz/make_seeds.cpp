/// @file fuzz-make-seeds CONFIGS CORPUS: runs small sessions of the scenes in CONFIGS and writes what was said in them,
/// as the first scripts of every target's corpus.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "dem-service/native/impactor.hpp"
#include "fe-service/impactor.hpp"
#include "fe-service/structure.hpp"
#include "played_scene.hpp"
#include "recorded.hpp"
#include "scene/groups.hpp"
#include "scene/load.hpp"
#include "unit/orchestrator/fake_backends.hpp"

namespace {

using namespace grainstep;
using fuzz::Script;

namespace fs = std::filesystem;

/// A scene that exists, made so small that its session has few and short messages.
struct SmallScene {
  const char* name;
  const char* file;
  std::vector<std::string> set;
  double end = 1e-5;  ///< s: some windows
};

const std::vector<SmallScene> small_scenes{
    {"beam-pulse", "loads/rectangular-pulse.yaml", {"structure.half_span=0.1", "structure.mesh.refinement=1"}},
    {"beam-blast", "loads/exponential-blast.yaml", {"structure.half_span=0.1", "structure.mesh.refinement=1"}},
    {"plate-pulse", "loads/plate-pulse.yaml", {"structure.half_span=0.1", "structure.mesh.refinement=1"}, 5e-6},
    {"free-mass", "loads/free-mass.yaml", {"steps.impactor=2.5 us"}},
    {"initial-velocity", "loads/impulsive-velocity.yaml", {"structure.half_span=0.2", "structure.mesh.refinement=1"}},
    {"foam",
     "small/beam-monolithic.yaml",
     {"structure.half_span=0.2", "structure.mesh.refinement=1", "impactor.type=foam", "impactor.foam.elements=4",
      "impactor.foam.shock_width=0.3"}},
    {"foam-plate",
     "small/plate-monolithic.yaml",
     {"structure.half_span=0.2", "structure.mesh.refinement=1", "impactor.type=foam", "impactor.foam.elements=4",
      "impactor.foam.shock_width=0.3"},
     3e-6},
    {"foam-sandwich",
     "small/beam-sandwich-c033.yaml",
     {"structure.half_span=0.05", "structure.mesh.refinement=1", "impactor.type=foam", "impactor.foam.elements=4",
      "impactor.foam.shock_width=0.3", "impactor.slug.half_width=0.04"},
     5e-6}};

const std::vector<SmallScene> small_slugs{
    {"slug",
     "small/beam-monolithic.yaml",
     {"structure.half_span=0.1", "structure.mesh.refinement=1", "impactor.slug.particle.diameter=4 mm",
      "impactor.slug.half_width=0.02", "impactor.slug.height=0.04"}},
    {"slug-mixed",
     "small/beam-monolithic.yaml",
     {"structure.half_span=0.1", "structure.mesh.refinement=1", "impactor.slug.particle.diameter=4 mm",
      "impactor.slug.half_width=0.02", "impactor.slug.height=0.1", "impactor.slug.size_distribution.uniform.width=0.15",
      "impactor.slug.surface_contact.tension_cutoff=true"}},
    {"slug-confined",
     "small/rigid-wall.yaml",
     {"impactor.slug.particle.diameter=4 mm", "impactor.slug.half_width=0.02", "impactor.slug.height=0.04",
      "impactor.slug.confined=true"}},
    {"slug-plate",
     "small/plate-monolithic.yaml",
     {"structure.half_span=0.1", "structure.mesh.refinement=1", "impactor.slug.half_width=0.02",
      "impactor.slug.height=0.03", "impactor.slug.slice_angle=20 deg"}}};

class Corpus {
 public:
  explicit Corpus(fs::path home) : home_(std::move(home)) {}

  void write(const std::string& target, const std::string& name, Script script, std::uint32_t variant) const {
    script.set_variant(variant);
    fs::create_directories(home_ / target);
    std::ofstream out(home_ / target / name, std::ios::binary);
    if (!script.SerializeToOstream(&out)) throw OutputError((home_ / target / name).string() + ": cannot be written");
  }

 private:
  fs::path home_;
};

scene::Scene load(const fs::path& configs, const SmallScene& small) {
  std::vector<std::string> set = small.set;
  for (const char* one : {"output.rows=3", "output.snapshots=1", "output.profiles=2"}) set.emplace_back(one);
  return scene::load_scene(configs / small.file, set);
}

/// Our own participants in a scene of ours: what the orchestrator tells them, and what they say to it.
void write_own(const fs::path& configs, const SmallScene& small, const Corpus& corpus) {
  const scene::Scene scene = load(configs, small);

  fe::Structure structure;
  fe::Impactor impactor;
  const fuzz::Recorded said =
      fuzz::record({.scene = scene, .hash = fuzz::scene_hash, .end = small.end}, impactor, structure);
  corpus.write("structure", small.name, said.to_structure, 0);
  corpus.write("impactor", small.name, said.to_impactor, 0);
  corpus.write("checks", std::string(small.name) + "-impactor", said.impactor, 0);
  corpus.write("checks", std::string(small.name) + "-structure", said.structure, 1);
}

/// The native particle engine in a scene of ours, over our structure.
void write_grains(const fs::path& configs, const SmallScene& small, const Corpus& corpus) {
  const scene::Scene scene = load(configs, small);
  fe::Structure structure;
  const auto engine = dem::native::make_impactor();
  const fuzz::Recorded said =
      fuzz::record({.scene = scene, .hash = fuzz::scene_hash, .end = small.end}, *engine, structure);
  corpus.write("grains", small.name, said.to_impactor, 0);
}

/// Sessions about the scene that fuzzed sessions are about.
void write_played(const Corpus& corpus) {
  const struct {
    const char* name;
    scene::Symmetry symmetry;
    std::uint32_t variant;
  } kinds[] = {{"plane", scene::SYMMETRY_PLANE_STRAIN, 0},
               {"space", scene::SYMMETRY_NONE, 2},
               {"ring", scene::SYMMETRY_AXISYMMETRIC, 4}};
  const auto write = [&](const std::string& name, std::uint32_t variant, const fuzz::Recorded& said) {
    for (const char* target : {"session", "recorder", "checks", "frame"}) {
      corpus.write(target, name + "-impactor", said.impactor, variant);
      corpus.write(target, name + "-structure", said.structure, variant + 1);
    }
  };
  for (const auto& kind : kinds) {
    const scene::Scene scene = fuzz::played_scene(kind.symmetry);
    const unsigned dimension = kind.symmetry == scene::SYMMETRY_NONE ? 3 : 2;
    write(kind.name, kind.variant,
          fuzz::record_honest({.scene = scene, .hash = fuzz::scene_hash, .end = fuzz::run_end}, dimension));
  }
  const scene::Scene scene = fuzz::played_scene(scene::SYMMETRY_PLANE_STRAIN);
  orchestrator::fake::BallImpactor ball;
  orchestrator::fake::SpringStructure spring;
  const fuzz::Recorded said =
      fuzz::record({.scene = scene, .hash = fuzz::scene_hash, .end = fuzz::run_end}, ball, spring);
  write("ball", 0, said);
  corpus.write("participant", "structure", said.to_structure, 0);
  corpus.write("participant", "impactor", said.to_impactor, 1);
  corpus.write("frame", "to-structure", said.to_structure, 0);
  corpus.write("frame", "to-impactor", said.to_impactor, 0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: fuzz-make-seeds CONFIGS CORPUS\n");
    return static_cast<int>(ExitCode::bad_input);
  }
  try {
    const Corpus corpus(argv[2]);
    write_played(corpus);
    for (const SmallScene& small : small_scenes) {
      std::printf("%s\n", small.name);
      write_own(argv[1], small, corpus);
    }
    for (const SmallScene& small : small_slugs) {
      std::printf("%s\n", small.name);
      write_grains(argv[1], small, corpus);
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(ExitCode::unforeseen);
  }
}
