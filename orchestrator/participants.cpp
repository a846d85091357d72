#include "orchestrator/participants.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "base/error.hpp"
#include "orchestrator/peer.hpp"
#include "process/launch.hpp"
#include "scene/groups.hpp"

namespace grainstep::orchestrator {

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
  const bool by_scene = role == wire::IMPACTOR ? scene.impactor().type() == scene::Impactor::TYPE_EXTERNAL
                                               : scene.structure().type() == scene::Structure::TYPE_EXTERNAL;
  return by_scene || std::ranges::find(options.external, name_of(role)) != options.external.end();
}

void check_connection(const scene::Scene& scene, const RunOptions& options) {
  if (!options.listen.empty()) {
    transport::ZmqOptions zmq;
    zmq.curve_dir = options.curve_dir;
    zmq.allow_plain_tcp = options.allow_plain_tcp;
    transport::check_endpoint(options.listen, transport::Use::listen, zmq);
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

bool has_particles(const scene::Scene& scene) {
  return scene::has_slug(scene) && scene.impactor().type() != scene::Impactor::TYPE_FOAM;
}

Participants::Participants(const scene::Scene& scene, const RunOptions& options)
    : options_(options),
      impactor_{wire::IMPACTOR,
                is_external(wire::IMPACTOR, scene, options),
                has_particles(scene),
                {"grainstep-dem"},
                nullptr},
      structure_{wire::STRUCTURE, is_external(wire::STRUCTURE, scene, options), false, {"grainstep-fe"}, nullptr} {
  if (!impactor_.mpi) {
    impactor_.command = {"grainstep-fe", "--role", "impactor"};
  }
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
  transport::ZmqOptions zmq;
  zmq.peer = name_of(side.role);
  const std::string endpoint = endpoint_of(side);
  if (transport::is_tcp(endpoint)) {
    zmq.curve_dir = options_.curve_dir;
    zmq.allow_plain_tcp = options_.allow_plain_tcp;
  }
  side.channel = transport::ZmqChannel::bind(endpoint, zmq);
}

void Participants::start(const Side& side, Supervision& supervision, const results::RunDirectory& directory) const {
  const std::string& endpoint = side.channel->endpoint();
  if (side.external) {
    const bool keys = transport::is_tcp(endpoint) && !options_.curve_dir.empty();
    std::string command;
    for (const std::string& word : side.command) command += word + " ";
    std::printf("waiting %.0f s for the %s; start it with:\n  %s--connect %s%s%s\n", options_.deadlines.connect_s,
                name_of(side.role), command.c_str(), endpoint.c_str(), keys ? " --curve-dir DIR" : "",
                options_.allow_plain_tcp ? " --allow-plain-tcp" : "");
    std::fflush(stdout);
    return;
  }
  process::Command command{.program = process::find_program(side.command.front()),
                           .arguments = {side.command.begin() + 1, side.command.end()},
                           .environment = {}};
  command.arguments.insert(command.arguments.end(), {"--connect", endpoint});
  if (side.mpi) {
    command = process::mpi_command(options_.ranks, std::move(command));
  }
  supervision.start(side.role, command, directory.logs() / (std::string(name_of(side.role)) + ".log"));
}

void Participants::start(Supervision& supervision, const results::RunDirectory& directory) {
  start(structure_, supervision, directory);
  start(impactor_, supervision, directory);
}

}  // namespace grainstep::orchestrator
