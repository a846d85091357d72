/// @file grainstep-keys DIR: makes the keys that encrypt and authenticate tcp connections.
#include <cstdio>

#include "base/error.hpp"
#include "transport/curve.hpp"

int main(int argc, char** argv) {
  using grainstep::ExitCode;
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(stderr,
                 "usage: grainstep-keys DIR\nMakes orchestrator.key, orchestrator.pub, participant.key and "
                 "participant.pub in DIR. The orchestrator needs\norchestrator.key and participant.pub, a "
                 "participant on another host participant.key and orchestrator.pub.\n");
    return static_cast<int>(ExitCode::bad_input);
  }
  try {
    grainstep::transport::make_keys(argv[1]);
    return static_cast<int>(ExitCode::done);
  } catch (const grainstep::InputError& error) {
    std::fprintf(stderr, "grainstep-keys: %s\n", error.what());
    return static_cast<int>(ExitCode::bad_input);
  }
}
