/// @file grainstep: run, check, show, study.
#include <cstdio>

#include "base/error.hpp"
#include "orchestrator/check_command.hpp"
#include "orchestrator/conformance/conformance_command.hpp"
#include "orchestrator/options.hpp"
#include "orchestrator/run_command.hpp"
#include "orchestrator/show_command.hpp"
#include "study/study_command.hpp"

namespace {

int fail(grainstep::ExitCode code, const std::exception& error) {
  std::fprintf(stderr, "grainstep: %s\n", error.what());
  return static_cast<int>(code);
}

int act(const grainstep::orchestrator::CommandLine& line) {
  if (line.run) {
    return grainstep::orchestrator::run(*line.run);
  }
  if (line.study) {
    return grainstep::study::study(*line.study);
  }
  if (line.conformance) {
    return grainstep::conformance::conformance(*line.conformance);
  }
  if (line.check) {
    grainstep::orchestrator::check(*line.check);
  } else if (line.show) {
    grainstep::orchestrator::show(*line.show);
  }
  return line.exit_code.value_or(0);
}

}  // namespace

int main(int argc, char** argv) {
  using grainstep::ExitCode;
  try {
    return act(grainstep::orchestrator::parse(argc, argv));
  } catch (const grainstep::InputError& error) {
    return fail(ExitCode::bad_input, error);
  } catch (const grainstep::NumericalError& error) {
    return fail(ExitCode::numerical, error);
  } catch (const grainstep::OutputError& error) {
    return fail(ExitCode::output, error);
  } catch (const grainstep::PeerError& error) {
    return fail(ExitCode::peer, error);
  } catch (const std::exception& error) {  // the system's refusals; caught, so that all that was made is cleaned away
    return fail(ExitCode::unforeseen, error);
  } catch (...) {
    std::fputs("grainstep: an exception without a text. Please report this.\n", stderr);
    return static_cast<int>(ExitCode::unforeseen);
  }
}
