#include <participant/program.hpp>
#include <participant/serve.hpp>

#include "spring.hpp"

int main(int argc, char** argv) {
  grainstep::participant::Program program("spring", "1", "A mass on a spring, as a structure of Grainstep");
  if (const auto code = program.parse(argc, argv)) return *code;
  return program.run([&program](grainstep::transport::Channel& channel) {
    Spring spring;
    return grainstep::participant::serve_structure(channel, spring, program.serving());
  });
}
