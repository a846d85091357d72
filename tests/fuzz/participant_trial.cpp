#include "participant_trial.hpp"

#include <sys/resource.h>

#include <sstream>

#include "base/assert.hpp"
#include "base/error.hpp"
#include "liar.hpp"

namespace grainstep::fuzz {
namespace {

/// Whoever serves gives way to others, by a step of the scheduler's for each script. Where the system allows it, this
/// takes them back.
class Priority {
 public:
  Priority() = default;
  Priority(const Priority&) = delete;
  Priority& operator=(const Priority&) = delete;
  ~Priority() { static_cast<void>(::setpriority(PRIO_PROCESS, 0, before_)); }

 private:
  int before_ = ::getpriority(PRIO_PROCESS, 0);
};

template <class Serve>
void try_serving(const Script& script, Serve serve) {
  Liar orchestrator(script, "orchestrator");
  std::ostringstream errors;
  const Priority priority;
  const int code = serve(orchestrator, participant::ServeOptions{.errors = &errors});
  if (code == static_cast<int>(ExitCode::done)) {
    ++statistics().complete;
    return;
  }
  const bool known = code == static_cast<int>(ExitCode::bad_input) || code == static_cast<int>(ExitCode::numerical) ||
                     code == static_cast<int>(ExitCode::peer);
  GS_ASSERT(known && errors.str().size() > std::string("error: \n").size(), std::to_string(code) + errors.str());
  ++statistics().blamed;
}

}  // namespace

void try_participant(const Script& script, participant::StructureBackend& backend, const ElementsOf& elements_of) {
  BoundedStructure bounded(backend, elements_of);
  try_serving(script, [&](transport::Channel& channel, const participant::ServeOptions& options) {
    return participant::serve_structure(channel, bounded, options);
  });
}

void try_participant(const Script& script, participant::ImpactorBackend& backend, const ElementsOf& elements_of) {
  BoundedImpactor bounded(backend, elements_of);
  try_serving(script, [&](transport::Channel& channel, const participant::ServeOptions& options) {
    return participant::serve_impactor(channel, bounded, options);
  });
}

}  // namespace grainstep::fuzz
