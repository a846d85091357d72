/// @file To be put in front of the system's library (LD_PRELOAD): refuses one poll() of the orchestrator's main thread,
/// as the system does when it is short of something. The first one after the file $GRAINSTEP_REFUSE was made, which it
/// removes; every other call, and every call of other programs, is the system's own. Only a call for the descriptors of
/// channels, processes and signals together: libzmq, which polls one to three, ends the process where it is refused.
#include <dlfcn.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace {

bool is_the_orchestrator() { return std::strcmp(program_invocation_short_name, "grainstep") == 0; }

constexpr nfds_t of_the_event_loop = 4;  // or more

bool is_to_be_refused(nfds_t count) {
  if (count < of_the_event_loop) return false;
  const char* trigger = std::getenv("GRAINSTEP_REFUSE");
  return trigger != nullptr && is_the_orchestrator() && ::gettid() == ::getpid() && ::unlink(trigger) == 0;
}

}  // namespace

extern "C" int poll(pollfd* items, nfds_t count, int timeout) {
  using Poll = int (*)(pollfd*, nfds_t, int);
  static const auto of_the_system = reinterpret_cast<Poll>(::dlsym(RTLD_NEXT, "poll"));
  if (is_to_be_refused(count)) {
    errno = EINVAL;
    return -1;
  }
  return of_the_system(items, count, timeout);
}
