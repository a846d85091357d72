/// @file A local process that somebody watches: started, its end noticed at once, ended, and never left behind.
///
/// The child leads its own process group, so that a Ctrl-C at the terminal reaches the parent alone, and receives
/// SIGKILL from the kernel when the thread that started it ends, however that happens (PR_SET_PDEATHSIG). Start
/// children from the main thread. What a child starts itself stays in its group and is killed with it by terminate();
/// mpirun gives each rank a group of its own, see launch.hpp.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grainstep::process {

struct Command {
  std::filesystem::path program;       ///< a path; find_program() in launch.hpp makes one from a name
  std::vector<std::string> arguments;  ///< without the program's own name
  std::vector<std::pair<std::string, std::string>> environment;  ///< added to the parent's, or in place of its values
};

class ChildProcess {
 public:
  /// Starts it; stdout and stderr are appended to `log`. InputError when the log or the program cannot be used.
  /// `name`: for people, e.g. "impactor".
  ChildProcess(std::string name, const Command& command, std::filesystem::path log);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  /// Kills what is left, without grace.
  ~ChildProcess();

  /// Readable, in poll(), from the moment when the process has ended. Valid as long as this object.
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] pid_t id() const noexcept { return id_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

  /// Whether it has ended by now. Does not wait.
  [[nodiscard]] bool ended() { return wait(std::chrono::milliseconds(0)); }
  /// Waits for its end; false when it still runs after that time.
  [[nodiscard]] bool wait(std::chrono::milliseconds longest);

  /// Whether a signal has stopped it (SIGSTOP, SIGTSTP) and none has let it go on.
  [[nodiscard]] bool is_stopped() const;

  /// SIGTERM to the group, without waiting.
  void ask_to_end() const noexcept;
  /// SIGTERM to the group, SIGKILL to what is left of it after `grace`; returns when the child is reaped.
  void terminate(std::chrono::milliseconds grace);

  /// Its exit code; nullopt while it runs and when a signal ended it.
  [[nodiscard]] std::optional<int> exit_code() const;
  /// "is running", "is stopped ...", "exited with code 3", "killed by signal 9 (SIGKILL)".
  [[nodiscard]] std::string describe_end() const;
  /// The last lines that it wrote, for an error message.
  [[nodiscard]] std::string log_tail(std::size_t lines) const;

 private:
  void start(const Command& command);
  void signal_group(int signal) const noexcept;
  void reap();

  std::string name_;
  std::filesystem::path log_;
  pid_t id_ = -1;
  int descriptor_ = -1;
  std::optional<int> status_;  // as waitpid gives it, once reaped
};

}  // namespace grainstep::process
