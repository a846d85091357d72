/// @file The command line of a participant's program, and how it ends.
///
///     int main(int argc, char** argv) {
///       participant::Program program("my-solver", "1.0", "A structure of my own");
///       if (const auto code = program.parse(argc, argv)) return *code;
///       return program.run([&](transport::Channel& channel) {
///         MyStructure mine;
///         return serve_structure(channel, mine, program.serving());
///       });
///     }
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "participant/connect.hpp"
#include "participant/serve.hpp"

namespace grainstep::participant {

class Program {
 public:
  Program(std::string name, std::string version, std::string text)
      : name_(std::move(name)), version_(std::move(version)), text_(std::move(text)) {}

  /// An option `--name TEXT` beside those of every participant (connect.hpp). `choices`, where there are any, are all
  /// that it takes. `value` holds the default, and outlives parse().
  void option(const std::string& name, const std::string& text, std::string& value,
              std::vector<std::string> choices = {});

  /// The same for a whole number in [least, most].
  void number(const std::string& name, const std::string& text, int& value, int least, int most);

  void flag(const std::string& name, const std::string& text, bool& value);

  /// The exit code where the command line was answered already (--help, --version) or cannot be used (it was said why).
  [[nodiscard]] std::optional<int> parse(int argc, const char* const* argv);

  [[nodiscard]] const ConnectOptions& connect() const { return connect_; }

  /// What serve_structure() and serve_impactor() are to know of this command line.
  [[nodiscard]] ServeOptions serving() const;

  /// Connects, then calls `serve` with the channel. Returns its exit code, or that of what went wrong, in one line on
  /// stderr: keys and endpoints that cannot be used (2), an orchestrator that is not there (4).
  [[nodiscard]] int run(const std::function<int(transport::Channel&)>& serve) const;

 private:
  struct Option {
    std::string name;
    std::string text;
    std::string* value;
    std::vector<std::string> choices;
  };
  struct Number {
    std::string name;
    std::string text;
    int* value;
    int least, most;
  };
  struct Flag {
    std::string name;
    std::string text;
    bool* value;
  };
  std::string name_, version_, text_;
  std::vector<Option> options_;
  std::vector<Number> numbers_;
  std::vector<Flag> flags_;
  ConnectOptions connect_;
};

}  // namespace grainstep::participant
