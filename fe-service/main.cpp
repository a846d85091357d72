/// @file grainstep-fe: the structure of a run, or an impactor without particles, as a program.
#include "fe-service/impactor.hpp"
#include "fe-service/structure.hpp"
#include "participant/program.hpp"
#include "participant/serve.hpp"

int main(int argc, char** argv) {
  using grainstep::transport::Channel;
  grainstep::participant::Program program("grainstep-fe", GRAINSTEP_VERSION,
                                          "Grainstep's structure: finite elements in step with what hits them");
  std::string role = "structure";
  program.option("role", "structure (default), or impactor: a foam projectile, a prescribed pressure, or no load", role,
                 {"structure", "impactor"});
  int threads = 1;
  program.number("threads", "Threads of a structure; results do not depend on their number", threads, 1, 1024);
  if (const auto code = program.parse(argc, argv)) return *code;
  return program.run([&program, &role, threads](Channel& channel) {
    if (role == "impactor") {
      grainstep::fe::Impactor impactor;
      return grainstep::participant::serve_impactor(channel, impactor, program.serving());
    }
    grainstep::fe::Structure structure(threads);
    return grainstep::participant::serve_structure(channel, structure, program.serving());
  });
}
