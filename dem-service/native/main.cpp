/// @file grainstep-grains: the native particle engine as a program.
#include "dem-service/native/impactor.hpp"
#include "participant/program.hpp"
#include "participant/serve.hpp"

int main(int argc, char** argv) {
  grainstep::participant::Program program(
      "grainstep-grains", GRAINSTEP_VERSION,
      "grainstep-grains: particles for Grainstep, computed on this host by an engine of its own.");
  int threads = 1;
  program.number("threads", "Threads; results do not depend on their number", threads, 1, 1024);
  if (const auto code = program.parse(argc, argv)) return *code;
  return program.run([&program, threads](grainstep::transport::Channel& channel) {
    const auto impactor = grainstep::dem::native::make_impactor(threads);
    return grainstep::participant::serve_impactor(channel, *impactor, program.serving());
  });
}
