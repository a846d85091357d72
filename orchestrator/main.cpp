/// @file grainstep: run, resume, check, show. Its commands `study` and `conformance` are another program
/// (study_main.cpp), which whoever wants a single run need not build (docs/decisions/0018-first-build.md).
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "base/error.hpp"
#include "orchestrator/command/check_command.hpp"
#include "orchestrator/command/command_line.hpp"
#include "orchestrator/command/end_of_program.hpp"
#include "orchestrator/command/run_command.hpp"
#include "orchestrator/command/show_command.hpp"
#include "process/launch.hpp"

namespace {

using namespace grainstep;

std::string other_program() {
  try {
    return process::find_program("grainstep-study");
  } catch (const InputError& error) {
    throw InputError(std::string(error.what()) + ". `study` and `conformance` are in it; `make build` builds all");
  }
}

/// This process becomes the other program, with the same command line.
[[noreturn]] void hand_on(char** argv) {
  const std::string program = other_program();
  ::execv(program.c_str(), argv);
  throw std::system_error(errno, std::generic_category(), program);
}

int act(const orchestrator::CommandLine& line, char** argv) {
  if (line.run) return orchestrator::run(*line.run);
  if (line.study || line.conformance) hand_on(argv);
  if (line.check) {
    orchestrator::check(*line.check);
  } else if (line.show) {
    orchestrator::show(*line.show);
  }
  return line.exit_code.value_or(0);
}

}  // namespace

int main(int argc, char** argv) {
  return orchestrator::end_of_program([&] { return act(orchestrator::parse(argc, argv), argv); });
}
