#include "transport/zmq_options.hpp"

#include "base/error.hpp"

namespace grainstep::transport {
namespace {

int milliseconds(double seconds) { return static_cast<int>(seconds * 1e3); }

}  // namespace

void check_endpoint(const std::string& endpoint, Use use, const ZmqOptions& options) {
  check_form(endpoint, use);
  if (options.curve_dir.empty() && !options.allow_plain_tcp && leaves_this_host(endpoint)) {
    throw InputError(endpoint +
                     ": leaves this host unencrypted; give the directory of the CURVE keys (--curve-dir), or "
                     "--allow-plain-tcp if the network is private");
  }
}

void set_options(zmq::socket_t& socket, const ZmqOptions& options) {
  namespace opt = zmq::sockopt;
  socket.set(opt::linger, milliseconds(options.linger_s));
  socket.set(opt::maxmsgsize, static_cast<std::int64_t>(options.largest_message));
  // Lock step keeps a handful of messages in flight; this only bounds the memory that a misbehaving peer can take.
  socket.set(opt::sndhwm, 1000);
  // Senders are held back by their own queue and the kernel's. Where a receiver's is full, libzmq 4.3.4 stops reading,
  // and aborts the process if the connection is lost in the meantime (its issue 3937): a process that stood still for
  // some seconds and went on met that.
  socket.set(opt::rcvhwm, 100'000);
  socket.set(opt::heartbeat_ivl, milliseconds(options.heartbeat_s));
  socket.set(opt::heartbeat_timeout, milliseconds(options.silence_s));
  // The peer drops us by the same measure, even where its own heartbeats are off (rounded to 0.1 s by the protocol).
  socket.set(opt::heartbeat_ttl, milliseconds(options.heartbeat_s + options.silence_s));
  // Who connects and then does not speak ZMTP, or is not answered, is dropped.
  socket.set(opt::handshake_ivl, 30'000);
  // Never reconnect by itself: the new connection could reach another run on the same endpoint. An interval of -1 would
  // say so too, but makes libzmq drop messages that have arrived and were not read yet.
  socket.set(opt::reconnect_ivl, 3'600'000);
}

void set_server_security(zmq::socket_t& socket, const std::optional<CurveKeys>& keys) {
  namespace opt = zmq::sockopt;
  socket.set(opt::zap_domain, "grainstep");  // also without CURVE: a second connector is turned away
  if (keys) {
    socket.set(opt::curve_server, true);
    socket.set(opt::curve_secretkey, keys->own_secret);
  }
}

void set_client_security(zmq::socket_t& socket, const std::optional<CurveKeys>& keys) {
  namespace opt = zmq::sockopt;
  if (keys) {
    socket.set(opt::curve_serverkey, keys->peer_public);
    socket.set(opt::curve_publickey, keys->own_public);
    socket.set(opt::curve_secretkey, keys->own_secret);
  }
}

void set_monitor_options(zmq::socket_t& monitor) {
  monitor.set(zmq::sockopt::linger, 0);
  monitor.set(zmq::sockopt::rcvhwm, 0);  // a full queue of events would block libzmq's own thread
}

}  // namespace grainstep::transport
