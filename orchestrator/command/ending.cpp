#include "orchestrator/command/ending.hpp"

#include <exception>
#include <new>

#include "orchestrator/process/interrupted.hpp"

namespace grainstep::orchestrator {

Ending ending_of_current_exception() {
  try {
    throw;
  } catch (const PeerError& error) {
    return {ExitCode::peer, error.what(), error.peer()};
  } catch (const InputError& error) {
    return {ExitCode::bad_input, error.what(), ""};
  } catch (const NumericalError& error) {
    return {ExitCode::numerical, error.what(), ""};
  } catch (const OutputError& error) {
    return {ExitCode::output, error.what(), ""};
  } catch (const Interrupted& error) {
    return {ExitCode::interrupted, error.what(), ""};
  } catch (const std::bad_alloc&) {
    return {ExitCode::unforeseen, "the system gives no more memory; grainstep check estimates what a scene takes", ""};
  } catch (const std::exception& error) {
    return {ExitCode::unforeseen, std::string("unforeseen: ") + error.what() + ". Please report this message.", ""};
  } catch (...) {
    return {ExitCode::unforeseen, "unforeseen: an exception without a text. Please report this.", ""};
  }
}

}  // namespace grainstep::orchestrator
