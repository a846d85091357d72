/// @file Every choice about a ZeroMQ socket, in one place.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <zmq.hpp>

#include "transport/curve.hpp"
#include "transport/endpoint.hpp"

namespace grainstep::transport {

struct ZmqOptions {
  std::string peer = "peer";             ///< the other end's name in errors
  std::filesystem::path curve_dir = {};  ///< keys (curve.hpp); empty: not encrypted
  bool among_participants = false;       ///< both ends are: the keys are those that they share
  bool allow_plain_tcp = false;  ///< unencrypted tcp beyond this host, e.g. inside a private network of containers
  double heartbeat_s = 1.0;      ///< a peer is asked for a sign of life this often ...
  /// ... and lost when no message of it has come for this long. Only for peers that are cut off or frozen: the end of a
  /// process closes its connection, which is noticed at once. A message counts when all of it is here, so that this
  /// also bounds how long a big one may take, over a slow network or on a machine with ten times the work that it has
  /// cores.
  double silence_s = 30.0;
  double linger_s = 10.0;      ///< how long closing waits until the last messages are on their way
  double full_queue_s = 60.0;  ///< how long send() bears a peer that reads nothing
  std::size_t largest_message = std::size_t{1} << 30;  ///< bytes; a longer one ends the connection
};

/// The type of socket at both ends. PAIR: exactly one peer, strict order, no routing frame, no distribution among
/// peers. Its manual's warning about tcp is about reconnection: we want none (a peer that was lost is lost; see
/// zmq_channel.hpp).
inline constexpr zmq::socket_type channel_socket_type = zmq::socket_type::pair;

/// InputError when `endpoint` is none (endpoint.hpp), or would carry data across a network in the clear and nobody
/// allowed that.
void check_endpoint(const std::string& endpoint, Use use, const ZmqOptions& options);

/// Options common to both ends.
void set_options(zmq::socket_t& socket, const ZmqOptions& options);
/// The binding end decides who may come in (zap.hpp); the connecting end shows its key.
void set_server_security(zmq::socket_t& socket, const std::optional<CurveKeys>& keys);
void set_client_security(zmq::socket_t& socket, const std::optional<CurveKeys>& keys);
/// The socket on which libzmq tells what happens to connections.
void set_monitor_options(zmq::socket_t& monitor);

}  // namespace grainstep::transport
