#include "process/interrupt.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace grainstep::process {
namespace {

// Under nohup a closed terminal is to be survived: a signal that is ignored would still be read from a signalfd.
bool is_ignored(int number) {
  struct sigaction now {};
  return ::sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

Interrupt::Interrupt() {
  sigset_t watched;
  sigemptyset(&watched);
  sigaddset(&watched, SIGINT);
  sigaddset(&watched, SIGTERM);
  sigaddset(&watched, SIGUSR1);
  if (!is_ignored(SIGHUP)) {
    sigaddset(&watched, SIGHUP);
  }
  ::pthread_sigmask(SIG_BLOCK, &watched, &before_);
  descriptor_ = ::signalfd(-1, &watched, SFD_CLOEXEC | SFD_NONBLOCK);
  if (descriptor_ < 0) {
    const int error = errno;
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    throw std::system_error(error, std::generic_category(), "signalfd");
  }
}

Interrupt::~Interrupt() {
  // One that nobody asked for any more would end the process as soon as it is let through.
  sigset_t wish;
  sigemptyset(&wish);
  sigaddset(&wish, SIGUSR1);
  const timespec at_once{};
  while (::sigtimedwait(&wish, nullptr, &at_once) == SIGUSR1) {
  }
  ::close(descriptor_);
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interrupt::look() {
  signalfd_siginfo info{};
  while (!raised_ && ::read(descriptor_, &info, sizeof info) == sizeof info) {
    if (info.ssi_signo == SIGUSR1) {
      asked_ = true;
      continue;
    }
    raised_ = true;
    sigset_t left = before_;
    sigaddset(&left, SIGUSR1);
    ::pthread_sigmask(SIG_SETMASK, &left, nullptr);  // the second one means it
  }
}

bool Interrupt::raised() {
  look();
  return raised_;
}

bool Interrupt::asked() {
  look();
  return std::exchange(asked_, false);
}

}  // namespace grainstep::process
