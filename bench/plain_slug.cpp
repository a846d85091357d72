/// @file plain_slug SCENE STEPS [KEY=VALUE...]: wall clock seconds of plain LAMMPS for the scene's slug on LAMMPS's own
/// rigid wall, packing and set-up not counted. bench/run divides the coupled run by it.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench/plain_slug.hpp"
#include "dem-service/mpi_start.hpp"
#include "scene/load.hpp"

int main(int argc, char** argv) try {
  using namespace grainstep;
  if (argc < 3) {
    std::fputs("usage: plain_slug SCENE STEPS [KEY=VALUE...]\n", stderr);
    return 2;
  }
  const std::vector<std::string> overrides(argv + 3, argv + argc);
  const scene::Scene scene = scene::load_scene(argv[1], overrides);
  const std::uint64_t steps = std::strtoull(argv[2], nullptr, 10);
  dem::start_mpi();
  const dem::SlugModel model = dem::make_slug_model(scene.impactor(), scene.symmetry(), scene.depth(), true);
  bench::PlainSlug slug(model, model.preferred_step);
  const auto began = std::chrono::steady_clock::now();
  slug.run(steps);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  std::printf("{\"particles\": %llu, \"steps\": %llu, \"wall_seconds\": %.6f}\n",
              static_cast<unsigned long long>(model.particles), static_cast<unsigned long long>(steps), wall.count());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "plain_slug: %s\n", error.what());
  return 2;
}
