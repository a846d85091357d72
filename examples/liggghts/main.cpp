#include <dem-service/mpi_start.hpp>
#include <participant/program.hpp>
#include <participant/serve.hpp>

#include "slug_impactor.hpp"

int main(int argc, char** argv) {
  grainstep::participant::Program program("grainstep-liggghts", "1", "Particles for Grainstep, computed by LIGGGHTS");
  std::string log;
  program.option("liggghts-log", "Write LIGGGHTS's own log to this file", log);
  if (const auto code = program.parse(argc, argv)) return *code;
  const int code = program.run([&program, &log](grainstep::transport::Channel& channel) {
    SlugImpactor slug(log);
    return grainstep::participant::serve_impactor(channel, slug, program.serving());
  });
  grainstep::dem::end_mpi();
  return code;
}
