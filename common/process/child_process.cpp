#include "process/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <map>
#include <system_error>

#include "base/descriptor.hpp"
#include "base/error.hpp"

namespace grainstep::process {
namespace {

[[noreturn]] void system_failure(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (auto& text : texts) {
    result.push_back(text.data());
  }
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> merged_environment(const Command& command) {
  std::map<std::string, std::string> values;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const auto equals = text.find('=');
    values[text.substr(0, equals)] = equals == std::string::npos ? "" : text.substr(equals + 1);
  }
  for (const auto& [key, value] : command.environment) {
    values[key] = value;
  }
  std::vector<std::string> result;
  for (const auto& [key, value] : values) {
    result.push_back(key + "=" + value);
  }
  return result;
}

/// All that the child needs between fork and exec, made before: there, only async-signal-safe calls are allowed.
struct Recipe {
  char* const* argv;
  char* const* envp;
  int log;
  int failure;  // written with errno when exec fails, closed by exec
  pid_t parent;
};

[[noreturn]] void become(const Recipe& recipe) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != recipe.parent) {  // the parent died before prctl
    ::_exit(127);
  }
  // The parent may have blocked or redirected signals for itself (interrupt.hpp).
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    ::signal(number, SIG_DFL);
  }
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(recipe.log, STDOUT_FILENO);
  ::dup2(recipe.log, STDERR_FILENO);
  ::execve(recipe.argv[0], recipe.argv, recipe.envp);
  const int error = errno;
  (void)!::write(recipe.failure, &error, sizeof error);
  ::_exit(127);
}

std::string signal_text(int number) {
  const char* name = ::sigabbrev_np(number);
  return "signal " + std::to_string(number) + (name == nullptr ? "" : std::string(" (SIG") + name + ")");
}

}  // namespace

ChildProcess::ChildProcess(std::string name, const Command& command, std::filesystem::path log)
    : name_(std::move(name)), log_(std::move(log)) {
  start(command);
}

ChildProcess::~ChildProcess() {
  try {
    terminate(std::chrono::milliseconds(0));
  } catch (...) {  // a destructor has nobody to tell; the kernel ends the child with us
  }
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void ChildProcess::start(const Command& command) {
  const Descriptor log(::open(log_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (log.get() < 0) {
    throw InputError(log_.string() + ": cannot be written: " + ::strerror(errno));
  }
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    system_failure("pipe2");
  }
  const Descriptor failure(ends[0]);
  Descriptor failure_child(ends[1]);

  std::vector<std::string> arguments = {command.program.string()};
  arguments.insert(arguments.end(), command.arguments.begin(), command.arguments.end());
  auto environment = merged_environment(command);
  const auto argv = pointers(arguments);
  const auto envp = pointers(environment);
  const Recipe recipe{argv.data(), envp.data(), log.get(), failure_child.get(), ::getpid()};

  id_ = ::fork();
  if (id_ < 0) {
    system_failure("fork");
  }
  if (id_ == 0) {
    become(recipe);
  }
  ::setpgid(id_, id_);  // both do it, so that the group exists whoever runs first
  descriptor_ = static_cast<int>(::syscall(SYS_pidfd_open, id_, 0));
  if (descriptor_ < 0) {
    const int error = errno;
    signal_group(SIGKILL);
    reap();
    errno = error;
    system_failure("pidfd_open (Linux 5.3 or newer is needed)");
  }
  failure_child.close();
  int error = 0;
  if (::read(failure.get(), &error, sizeof error) == sizeof error) {
    reap();
    ::close(std::exchange(descriptor_, -1));  // no destructor runs for what a constructor leaves
    throw InputError(name_ + ": cannot start " + command.program.string() + ": " + ::strerror(error));
  }
}

bool ChildProcess::wait(std::chrono::milliseconds longest) {
  if (status_) {
    return true;
  }
  const auto deadline = std::chrono::steady_clock::now() + longest;
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd item{descriptor_, POLLIN, 0};
    const int ready = ::poll(&item, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready > 0) {
      reap();
      return true;
    }
    if (ready < 0 && errno != EINTR) {
      system_failure("poll on a child process");
    }
    if (ready == 0 && left.count() <= 0) {
      return false;
    }
  }
}

void ChildProcess::ask_to_end() const noexcept {
  if (!status_ && id_ > 0) {
    signal_group(SIGTERM);
  }
}

void ChildProcess::terminate(std::chrono::milliseconds grace) {
  if (status_ || id_ < 0) {
    return;
  }
  if (grace.count() > 0) {
    signal_group(SIGTERM);
    // Looked at without reaping: a zombie keeps its group's number from being given to somebody else.
    pollfd item{descriptor_, POLLIN, 0};
    while (::poll(&item, 1, static_cast<int>(grace.count())) < 0 && errno == EINTR) {
    }
  }
  reap();
}

/// Kills what is left of the group while the child still holds its number, then takes the child's status.
void ChildProcess::reap() {
  signal_group(SIGKILL);
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0) {
    if (errno != EINTR) {
      system_failure("waitpid");
    }
  }
  status_ = status;
}

void ChildProcess::signal_group(int signal) const noexcept { ::kill(-id_, signal); }

std::optional<int> ChildProcess::exit_code() const {
  return status_ && WIFEXITED(*status_) ? std::optional(WEXITSTATUS(*status_)) : std::nullopt;
}

bool ChildProcess::is_stopped() const {
  if (status_) return false;
  siginfo_t info{};
  const bool told = ::waitid(P_PID, static_cast<id_t>(id_), &info, WSTOPPED | WNOHANG | WNOWAIT) == 0;
  return told && info.si_pid == id_;
}

std::string ChildProcess::describe_end() const {
  if (!status_) {
    return is_stopped() ? "is stopped (SIGSTOP, or a debugger); SIGCONT would let it go on" : "is running";
  }
  if (const auto code = exit_code()) {
    return "exited with code " + std::to_string(*code);
  }
  return "killed by " + signal_text(WTERMSIG(*status_));
}

std::string ChildProcess::log_tail(std::size_t lines) const {
  std::ifstream in(log_);
  std::deque<std::string> last;
  for (std::string line; std::getline(in, line);) {
    last.push_back(line);
    if (last.size() > lines) {
      last.pop_front();
    }
  }
  std::string text;
  for (const auto& line : last) {
    text += line + "\n";
  }
  return text;
}

}  // namespace grainstep::process
