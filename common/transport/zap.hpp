/// @file Answers libzmq's question who may come in (ZAP, https://rfc.zeromq.org/spec/27/), in the channel's own thread.
#pragma once

#include <optional>
#include <zmq.hpp>

#include "transport/curve.hpp"

namespace grainstep::transport {

class ZapHandler {
 public:
  /// Must exist before the socket that it guards is bound; one per context.
  ZapHandler(zmq::context_t& context, const std::optional<CurveKeys>& keys);

  /// Answers all waiting questions. Admits the holder of the peer's key (anyone, without CURVE), and nobody when
  /// `taken`.
  void answer(bool taken);

  [[nodiscard]] zmq::socket_t& socket() noexcept { return socket_; }

 private:
  [[nodiscard]] bool admits(const zmq::message_t& mechanism, const zmq::message_t* key) const;

  zmq::socket_t socket_;
  std::optional<std::array<std::uint8_t, 32>> peer_key_;
};

}  // namespace grainstep::transport
