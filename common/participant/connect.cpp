#include "participant/connect.hpp"

#include "base/error.hpp"
#include "participant/positive_number.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::participant {

void add_connect_options(CLI::App& app, ConnectOptions& options) {
  app.add_option("--connect", options.endpoint, "Where the orchestrator listens: ipc:///path or tcp://host:port")
      ->required();
  app.add_option("--curve-dir", options.curve_dir, "Directory with participant.key and orchestrator.pub");
  app.add_option("--connect-deadline", options.connect_deadline_s, "Seconds to wait for the orchestrator's answer")
      ->check(positive_number())
      ->capture_default_str();
  app.add_flag("--allow-plain-tcp", options.allow_plain_tcp, "Unencrypted tcp beyond this host");
}

std::unique_ptr<transport::Channel> open(const ConnectOptions& options) {
  transport::ZmqOptions zmq;
  zmq.peer = "orchestrator";
  if (!options.curve_dir.empty() && options.endpoint.starts_with("ipc://")) {
    throw InputError("--curve-dir " + options.curve_dir.string() + ": nothing is encrypted over the local socket " +
                     options.endpoint + "; leave it out");
  }
  zmq.curve_dir = options.curve_dir;
  zmq.allow_plain_tcp = options.allow_plain_tcp;
  return transport::ZmqChannel::connect(options.endpoint,
                                        transport::in(std::chrono::duration<double>(options.connect_deadline_s)), zmq);
}

}  // namespace grainstep::participant
