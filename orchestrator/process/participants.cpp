#include "orchestrator/process/participants.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "base/error.hpp"
#include "orchestrator/session/peer.hpp"
#include "orchestrator/session/session.hpp"
#include "process/launch.hpp"

namespace grainstep::orchestrator {
namespace {

/// What was said about connections that may leave this host: checked before anything starts, and used when it does.
transport::ZmqOptions security(const RunOptions& options) {
  transport::ZmqOptions zmq;
  zmq.curve_dir = options.curve_dir;
  zmq.allow_plain_tcp = options.allow_plain_tcp;
  return zmq;
}

}  // namespace

std::string next_port(const std::string& endpoint) {
  const std::size_t colon = endpoint.rfind(':');
  const std::string port = endpoint.substr(colon + 1);
  unsigned number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (port == "*" || (error == std::errc() && number == 0)) {
    return endpoint;
  }
  if (error != std::errc() || end != port.data() + port.size() || number >= 65535) {
    throw InputError("--listen " + endpoint + ": expected tcp://HOST:PORT with a PORT below 65535");
  }
  return endpoint.substr(0, colon + 1) + std::to_string(number + 1);
}

bool is_external(wire::Role role, const scene::Scene& scene, const RunOptions& options) {
  return scene::program_of(scene, role).command.empty() ||
         std::ranges::find(options.external, name_of(role)) != options.external.end();
}

void check_programs(const scene::Scene& scene, const RunOptions& options) {
  for (const wire::Role role : {wire::IMPACTOR, wire::STRUCTURE}) {
    const scene::Program program = scene::program_of(scene, role);
    const std::string key = std::string(name_of(role)) + ".program";
    const auto sets_it = [&key](const std::string& set) { return set.starts_with(key + "="); };
    const bool said = options.allow_program || std::ranges::any_of(options.scene.set, sets_it);
    if (program.own || said || is_external(role, scene, options)) continue;
    throw InputError(key + ": the scene would start '" + program.command.front() +
                     "', which is not one of Grainstep's own programs. If you mean it, add --set " + key + "=" +
                     program.command.front() + ", or --allow-program");
  }
}

void check_deck(const scene::Scene& scene, const RunOptions& options) {
  if (scene.impactor().type() != scene::Impactor::TYPE_DECK || options.allow_deck) return;
  if (is_external(wire::IMPACTOR, scene, options)) return;
  const std::string& file = scene.impactor().deck().file();
  throw InputError("impactor.deck: the scene would run the LAMMPS script " +
                   (file.empty() ? "in it" : "'" + file + "'") +
                   ", which can do anything on this machine. If you mean it, add --allow-deck");
}

void check_connection(const scene::Scene& scene, const RunOptions& options) {
  if (!options.listen.empty()) {
    transport::check_endpoint(options.listen, transport::Use::listen, security(options));
    if (!transport::is_tcp(options.listen)) {
      throw InputError("--listen " + options.listen +
                       ": expected tcp://HOST:PORT; without --listen, participants connect over a local socket");
    }
    if (!is_external(wire::IMPACTOR, scene, options) && !is_external(wire::STRUCTURE, scene, options)) {
      throw InputError("--listen " + options.listen +
                       ": nobody would connect, both participants are started here; add --external impactor or "
                       "--external structure");
    }
    if (!options.curve_dir.empty()) {
      static_cast<void>(transport::load_keys(options.curve_dir, transport::Side::orchestrator));
    }
  } else if (!options.curve_dir.empty()) {
    throw InputError("--curve-dir " + options.curve_dir.string() +
                     ": nothing to encrypt, participants connect over a local socket; add --listen tcp://HOST:PORT");
  }
}

Participants::Participants(const scene::Scene& scene, const RunOptions& options, const ThreadShares& threads)
    : options_(options),
      impactor_{wire::IMPACTOR,
                is_external(wire::IMPACTOR, scene, options),
                scene::program_of(scene, wire::IMPACTOR),
                threads.impactor,
                scene.impactor().type() == scene::Impactor::TYPE_DECK,
                nullptr},
      structure_{wire::STRUCTURE,
                 is_external(wire::STRUCTURE, scene, options),
                 scene::program_of(scene, wire::STRUCTURE),
                 threads.structure,
                 false,
                 nullptr} {
  open(impactor_);
  open(structure_);
}

std::string Participants::endpoint_of(const Side& side) const {
  if (!side.external || options_.listen.empty()) {
    return "ipc://" + (sockets_.path() / name_of(side.role)).string();
  }
  return side.role == wire::IMPACTOR ? options_.listen : next_port(options_.listen);
}

void Participants::open(Side& side) {
  const std::string endpoint = endpoint_of(side);
  transport::ZmqOptions zmq = transport::is_tcp(endpoint) ? security(options_) : transport::ZmqOptions{};
  zmq.peer = name_of(side.role);
  side.channel = transport::ZmqChannel::bind(endpoint, zmq);
}

bool Participants::listens_for_data(const Side& side) const {
  return options_.path == text_of(Path::direct) && side.role == wire::STRUCTURE && side.program.own;
}

void Participants::tell_how_to_start(const Side& side) const {
  const std::string& endpoint = side.channel->endpoint();
  const bool keys = transport::is_tcp(endpoint) && !options_.curve_dir.empty();
  std::string command;
  for (const std::string& word : side.program.command) command += word + " ";
  std::printf("waiting %.0f s for the %s; start it with:\n  %s--connect %s%s%s%s\n", options_.deadlines.connect_s,
              name_of(side.role), command.c_str(), endpoint.c_str(), keys ? " --curve-dir DIR" : "",
              options_.allow_plain_tcp ? " --allow-plain-tcp" : "",
              listens_for_data(side) ? " --data-listen tcp://HOST:PORT" : "");
  std::fflush(stdout);
}

void Participants::start(const Side& side, Supervision& supervision, const std::filesystem::path& logs) const {
  const std::vector<std::string>& words = side.program.command;
  process::Command command{.program = process::find_program(words.front()),
                           .arguments = {words.begin() + 1, words.end()},
                           .environment = {}};
  command.arguments.insert(command.arguments.end(), {"--connect", side.channel->endpoint()});
  if (listens_for_data(side)) {
    command.arguments.insert(command.arguments.end(),
                             {"--data-listen", "ipc://" + (sockets_.path() / "data").string()});
  }
  if (side.deck) command.arguments.emplace_back("--allow-deck");
  if (side.threads > 1) command.arguments.insert(command.arguments.end(), {"--threads", std::to_string(side.threads)});
  if (side.program.ranks) {
    command = process::mpi_command(options_.ranks, std::move(command));
  }
  supervision.start(side.role, command, logs / (std::string(name_of(side.role)) + ".log"));
}

void Participants::start(Supervision& supervision, const std::filesystem::path& logs, Others others) {
  for (const Side* side : {&structure_, &impactor_}) {
    if (!side->external) {
      start(*side, supervision, logs);
    } else if (others == Others::told) {
      tell_how_to_start(*side);
    }
  }
}

}  // namespace grainstep::orchestrator
