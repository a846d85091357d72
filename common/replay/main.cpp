/// @file grainstep-replay: one side of a run as another run has recorded it, as a program.
#include "participant/program.hpp"
#include "participant/serve.hpp"
#include "replay/replayed_load.hpp"
#include "replay/replayed_surface.hpp"

int main(int argc, char** argv) {
  using grainstep::transport::Channel;
  grainstep::participant::Program program("grainstep-replay", GRAINSTEP_VERSION,
                                          "One side of a run as another run has recorded it");
  std::string role = "structure";
  program.option("role", "structure (default), or impactor", role, {"structure", "impactor"});
  if (const auto code = program.parse(argc, argv)) return *code;
  return program.run([&program, &role](Channel& channel) {
    if (role == "impactor") {
      grainstep::replay::ReplayedLoad impactor;
      return grainstep::participant::serve_impactor(channel, impactor, program.serving());
    }
    grainstep::replay::ReplayedSurface structure;
    return grainstep::participant::serve_structure(channel, structure, program.serving());
  });
}
