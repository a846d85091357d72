#include "orchestrator/command/end_of_program.hpp"

#include <csignal>
#include <cstdio>

#include "base/error.hpp"
#include "base/room.hpp"

namespace grainstep::orchestrator {
namespace {

int fail(ExitCode code, const std::exception& error) {
  std::fprintf(stderr, "grainstep: %s\n", error.what());
  return static_cast<int>(code);
}

}  // namespace

int end_of_program(const std::function<int()>& act) {
  // A limit on the size of files is a full disk: the write fails and says so. By itself this signal ends a program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    base::require_room();
    return act();
  } catch (const InputError& error) {
    return fail(ExitCode::bad_input, error);
  } catch (const NumericalError& error) {
    return fail(ExitCode::numerical, error);
  } catch (const OutputError& error) {
    return fail(ExitCode::output, error);
  } catch (const PeerError& error) {
    return fail(ExitCode::peer, error);
  } catch (const std::exception& error) {  // the system's refusals; caught, so that all that was made is cleaned away
    return fail(ExitCode::unforeseen, error);
  } catch (...) {
    std::fputs("grainstep: an exception without a text. Please report this.\n", stderr);
    return static_cast<int>(ExitCode::unforeseen);
  }
}

}  // namespace grainstep::orchestrator
