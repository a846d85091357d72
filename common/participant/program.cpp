#include "participant/program.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/error.hpp"
#include "base/room.hpp"
#include "participant/seconds_to_wait.hpp"

namespace grainstep::participant {
namespace {

void add_connect_options(CLI::App& app, ConnectOptions& options) {
  app.add_option("--connect", options.endpoint, "Where the orchestrator listens: ipc:///path or tcp://host:port")
      ->required();
  app.add_option("--curve-dir", options.curve_dir, "Directory with participant.key and orchestrator.pub");
  app.add_option("--connect-deadline", options.connect_deadline_s, "Seconds to wait for the orchestrator's answer")
      ->check(seconds_to_wait())
      ->capture_default_str();
  app.add_flag("--allow-plain-tcp", options.allow_plain_tcp, "Unencrypted tcp beyond this host");
  app.add_option("--data-listen", options.data_listen,
                 "Of a structure: where the impactor may connect for forces and motion (grainstep run --path direct), "
                 "ipc:///path or tcp://HOST:PORT; HOST may be *");
}

}  // namespace

void Program::option(const std::string& name, const std::string& text, std::string& value,
                     std::vector<std::string> choices) {
  options_.push_back({.name = name, .text = text, .value = &value, .choices = std::move(choices)});
}

void Program::number(const std::string& name, const std::string& text, int& value, int least, int most) {
  numbers_.push_back({.name = name, .text = text, .value = &value, .least = least, .most = most});
}

void Program::flag(const std::string& name, const std::string& text, bool& value) {
  flags_.push_back({.name = name, .text = text, .value = &value});
}

std::optional<int> Program::parse(int argc, const char* const* argv) {
  CLI::App app(text_, name_);
  add_connect_options(app, connect_);
  for (Option& one : options_) {
    CLI::Option* added = app.add_option("--" + one.name, *one.value, one.text);
    if (!one.choices.empty()) added->check(CLI::IsMember(one.choices));
  }
  for (Number& one : numbers_) {
    app.add_option("--" + one.name, *one.value, one.text)
        ->check(CLI::Range(one.least, one.most))
        ->capture_default_str();
  }
  for (Flag& one : flags_) app.add_flag("--" + one.name, *one.value, one.text);
  app.set_version_flag("--version", version_);
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_input);
  }
}

ServeOptions Program::serving() const {
  ServeOptions out;
  out.direct = {.listen = connect_.data_listen,
                .curve_dir = connect_.curve_dir,
                .allow_plain_tcp = connect_.allow_plain_tcp,
                .orchestrator = connect_.endpoint};
  return out;
}

int Program::run(const std::function<int(transport::Channel&)>& serve) const {
  const auto failed = [this](ExitCode code, const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name_.c_str(), error.what());
    return static_cast<int>(code);
  };
  try {
    base::require_room();
    const auto channel = open(connect_);
    return serve(*channel);
  } catch (const InputError& error) {
    return failed(ExitCode::bad_input, error);
  } catch (const PeerError& error) {
    return failed(ExitCode::peer, error);
  }
}

}  // namespace grainstep::participant
