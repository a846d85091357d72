#include "transport/zmq_channel.hpp"

#include <sys/epoll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <thread>

#include "base/error.hpp"

namespace grainstep::transport {
namespace {

constexpr const char* monitor_endpoint = "inproc://grainstep.monitor";
constexpr int watched_events = ZMQ_EVENT_ACCEPTED | ZMQ_EVENT_CONNECTED | ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_CLOSED |
                               ZMQ_EVENT_CONNECT_RETRIED | ZMQ_EVENT_HANDSHAKE_SUCCEEDED |
                               ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                               ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;

std::chrono::milliseconds until(Deadline deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
  return std::clamp(left, std::chrono::milliseconds(0), std::chrono::milliseconds(3'600'000));
}

std::optional<CurveKeys> keys_for(const ZmqOptions& options, Side side) {
  return options.curve_dir.empty() ? std::nullopt : std::optional(load_keys(options.curve_dir, side));
}

}  // namespace

ZmqChannel::ZmqChannel(const std::string& endpoint, End end, const ZmqOptions& options)
    : options_(options),
      context_(1),
      socket_(context_, channel_socket_type),
      monitor_(context_, zmq::socket_type::pair) {
  check_endpoint(endpoint, end == End::bind ? Use::listen : Use::connect, options_);
  set_options(socket_, options_);
  set_monitor_options(monitor_);
  if (::zmq_socket_monitor(socket_.handle(), monitor_endpoint, watched_events) != 0) {
    throw std::system_error(errno, std::generic_category(), "zmq_socket_monitor");
  }
  monitor_.connect(monitor_endpoint);
  const auto keys = keys_for(options_, options_.among_participants ? Side::among_participants
                                       : end == End::bind          ? Side::orchestrator
                                                                   : Side::participant);
  try {
    if (end == End::bind) {
      zap_.emplace(context_, keys);
      set_server_security(socket_, keys);
      socket_.bind(endpoint);
    } else {
      set_client_security(socket_, keys);
      socket_.connect(endpoint);
    }
  } catch (const zmq::error_t& error) {
    throw InputError(endpoint + ": cannot " + (end == End::bind ? "listen there: " : "connect to that: ") +
                     error.what());
  }
  endpoint_ = socket_.get(zmq::sockopt::last_endpoint);
  open_wakeup();
}

ZmqChannel::~ZmqChannel() {
  if (wakeup_ >= 0) {
    ::close(wakeup_);
  }
  // Events that nobody can receive any more would be leaked by libzmq.
  ::zmq_socket_monitor(socket_.handle(), nullptr, 0);
  if (watch_.lost() || !watch_.connected()) {
    socket_.set(zmq::sockopt::linger, 0);
  }
}

std::unique_ptr<ZmqChannel> ZmqChannel::bind(const std::string& endpoint, const ZmqOptions& options) {
  return std::unique_ptr<ZmqChannel>(new ZmqChannel(endpoint, End::bind, options));
}

std::unique_ptr<ZmqChannel> ZmqChannel::connect(const std::string& endpoint, Deadline deadline,
                                                const ZmqOptions& options) {
  constexpr auto pause = std::chrono::milliseconds(100);
  std::string refusal;
  do {
    std::unique_ptr<ZmqChannel> channel(new ZmqChannel(endpoint, End::connect, options));
    if (channel->wait_for_peer(deadline)) {
      return channel;
    }
    refusal = channel->watch_.refusal();
    channel.reset();
    std::this_thread::sleep_until(std::min(deadline, Clock::now() + pause));
  } while (Clock::now() < deadline);
  throw PeerError(options.peer, "no connection to " + endpoint +
                                    " before the deadline: " + (refusal.empty() ? "nobody answered there" : refusal));
}

void ZmqChannel::open_wakeup() {
  wakeup_ = ::epoll_create1(EPOLL_CLOEXEC);
  const auto add = [this](zmq::socket_t& socket) {
    epoll_event event{};
    event.events = EPOLLIN;
    return ::epoll_ctl(wakeup_, EPOLL_CTL_ADD, socket.get(zmq::sockopt::fd), &event) == 0;
  };
  if (wakeup_ < 0 || !add(socket_) || !add(monitor_) || (zap_ && !add(zap_->socket()))) {
    throw std::system_error(errno, std::generic_category(), "epoll over a channel's sockets");
  }
}

void ZmqChannel::lose() const {
  throw PeerError(options_.peer,
                  "connection lost (" + endpoint_ + "): the process ended, was frozen, or cannot be reached any more");
}

bool ZmqChannel::take(Bytes& message) {
  zmq::message_t part;
  if (!socket_.recv(part, zmq::recv_flags::dontwait)) {
    return false;
  }
  if (part.more()) {
    throw PeerError(options_.peer, "sent a message of several parts, expected single ones");
  }
  if (!watch_.knows_connection()) {
    handle_events();
    watch_.heard_from(::zmq_msg_get(part.handle(), ZMQ_SRCFD));
  }
  const auto* const bytes = static_cast<const std::byte*>(part.data());
  message.assign(bytes, bytes + part.size());
  return true;
}

void ZmqChannel::handle_events() {
  zmq::message_t event;
  zmq::message_t address;
  while (monitor_.recv(event, zmq::recv_flags::dontwait)) {
    (void)monitor_.recv(address, zmq::recv_flags::none);  // parts arrive together
    std::uint16_t number = 0;
    std::uint32_t value = 0;
    std::memcpy(&number, event.data(), sizeof number);
    std::memcpy(&value, static_cast<const char*>(event.data()) + sizeof number, sizeof value);
    watch_.see(number, value);
  }
  if (zap_) {
    zap_->answer(watch_.connected());
  }
}

/// Blocks until something happens, or the deadline. `events` of interest on the socket itself; 0: connection events
/// only.
void ZmqChannel::wait(short events, Deadline deadline) {
  std::array<zmq::pollitem_t, 3> items = {zmq::pollitem_t{monitor_.handle(), 0, ZMQ_POLLIN, 0},
                                          zmq::pollitem_t{socket_.handle(), 0, events, 0}, zmq::pollitem_t{}};
  std::size_t count = events == 0 ? 1 : 2;
  if (zap_) {
    items[count++] = zmq::pollitem_t{zap_->socket().handle(), 0, ZMQ_POLLIN, 0};
  }
  if (::zmq_poll(items.data(), static_cast<int>(count), until(deadline).count()) < 0 && errno != EINTR) {
    throw zmq::error_t();
  }
}

bool ZmqChannel::receive(Bytes& message, Deadline deadline) {
  while (true) {
    if (take(message)) {
      return true;
    }
    handle_events();
    if (watch_.lost()) {
      if (take(message)) {  // it arrived between the look above and the news of the loss
        return true;
      }
      lose();
    }
    if (Clock::now() >= deadline) {
      return false;
    }
    wait(ZMQ_POLLIN, deadline);
  }
}

void ZmqChannel::send(std::span<const std::byte> message) {
  const Deadline deadline = in(std::chrono::duration<double>(options_.full_queue_s));
  while (true) {
    handle_events();
    if (watch_.lost()) {
      lose();
    }
    if (socket_.send(zmq::const_buffer(message.data(), message.size()), zmq::send_flags::dontwait)) {
      return;
    }
    if (Clock::now() >= deadline) {
      throw PeerError(options_.peer, watch_.connected() ? "does not read its messages" : "has not connected");
    }
    wait(ZMQ_POLLOUT, deadline);
  }
}

bool ZmqChannel::wait_for_peer(Deadline deadline) {
  const bool connecting = !zap_;
  while (true) {
    handle_events();
    if (watch_.connected()) {
      return true;
    }
    if ((connecting && watch_.attempt_failed()) || Clock::now() >= deadline) {
      return false;
    }
    wait(0, deadline);
  }
}

}  // namespace grainstep::transport
