#include "participant/connect.hpp"

#include "base/error.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::participant {

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
