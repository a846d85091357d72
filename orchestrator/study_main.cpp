/// @file grainstep-study: what `grainstep study` and `grainstep conformance` become. Takes the command line of those.
#include "orchestrator/command/command_line.hpp"
#include "orchestrator/command/end_of_program.hpp"
#include "orchestrator/conformance/conformance_command.hpp"
#include "orchestrator/study/study_command.hpp"

int main(int argc, char** argv) {
  using namespace grainstep;
  return orchestrator::end_of_program([&] {
    const orchestrator::CommandLine line = orchestrator::parse(argc, argv);
    if (line.study) return study::study(*line.study);
    if (line.conformance) return conformance::conformance(*line.conformance);
    return line.exit_code.value_or(0);
  });
}
