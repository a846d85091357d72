/// @file Channels between processes and hosts over ZeroMQ: "ipc:///path" or "tcp://host:port".
///
/// A connection is made once. When it breaks, for whatever reason, the peer is lost for good: a process that was killed
/// is noticed at once, one that is frozen or cut off within ZmqOptions heartbeat_s + silence_s of its last message.
/// What it had sent before is delivered first. Nobody else can take the place of a peer; further connectors are turned
/// away.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <zmq.hpp>

#include "transport/channel.hpp"
#include "transport/peer_watch.hpp"
#include "transport/zap.hpp"
#include "transport/zmq_options.hpp"

namespace grainstep::transport {

/// The binding end admits its peer inside receive(), send() and wait_for_peer() only: somebody must call one of them.
class ZmqChannel final : public Channel {
 public:
  /// Listens; the peer may come later. tcp takes "*" or 0 for a free port: ask endpoint(). The orchestrator's side.
  /// InputError when the endpoint cannot be had.
  [[nodiscard]] static std::unique_ptr<ZmqChannel> bind(const std::string& endpoint, const ZmqOptions& options = {});

  /// Tries until somebody answers; PeerError at the deadline, saying why. The participant's side.
  [[nodiscard]] static std::unique_ptr<ZmqChannel> connect(const std::string& endpoint, Deadline deadline,
                                                           const ZmqOptions& options = {});

  ZmqChannel(const ZmqChannel&) = delete;
  ZmqChannel& operator=(const ZmqChannel&) = delete;
  /// Waits at most linger_s for the last messages to leave.
  ~ZmqChannel() override;

  void send(std::span<const std::byte> message) override;
  [[nodiscard]] bool receive(Bytes& message, Deadline deadline) override;
  [[nodiscard]] int wakeup() const override { return wakeup_; }

  /// True once the peer is connected; false at the deadline.
  [[nodiscard]] bool wait_for_peer(Deadline deadline);

  /// Where a peer can connect to.
  [[nodiscard]] const std::string& endpoint() const noexcept { return endpoint_; }

 private:
  enum class End { bind, connect };
  ZmqChannel(const std::string& endpoint, End end, const ZmqOptions& options);

  bool take(Bytes& message);
  void handle_events();
  void wait(short events, Deadline deadline);
  void open_wakeup();
  [[noreturn]] void lose() const;

  ZmqOptions options_;
  std::string endpoint_;
  zmq::context_t context_;
  std::optional<ZapHandler> zap_;  // binding end only
  zmq::socket_t socket_;
  zmq::socket_t monitor_;
  PeerWatch watch_;
  int wakeup_ = -1;  // epoll over everything that can say something
};

}  // namespace grainstep::transport
