#include "participant/direct_path.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <thread>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "transport/local_address.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::participant {
namespace {

using transport::Clock;
using transport::Deadline;
using transport::ZmqChannel;

constexpr auto between_looks = std::chrono::milliseconds(5);
/// One that is given up looks like a lost peer at the other end: it must be longer than a handshake takes anywhere.
constexpr auto an_attempt = std::chrono::seconds(10);
/// Whoever is gone is missed by the orchestrator as well, which says so better and stops this side.
constexpr auto patience_after_a_loss = std::chrono::seconds(10);
constexpr const char* advice = "; --path hub takes another way";

transport::ZmqOptions zmq_options(const DirectOptions& options, const std::string& endpoint, wire::Role role) {
  transport::ZmqOptions zmq;
  zmq.peer = other_side(role);
  if (transport::is_tcp(endpoint)) zmq.curve_dir = options.curve_dir;
  zmq.among_participants = true;
  zmq.allow_plain_tcp = options.allow_plain_tcp;
  return zmq;
}

/// Looks elsewhere while it waits.
class Looking final : public transport::Channel {
 public:
  Looking(std::unique_ptr<ZmqChannel> inner, WhileWaiting look) : inner_(std::move(inner)), look_(std::move(look)) {}

  void send(std::span<const std::byte> message) override {
    or_lost([&] {
      inner_->send(message);
      return true;
    });
  }

  bool receive(transport::Bytes& message, Deadline deadline) override {
    return or_lost([&] {
      while (true) {
        const Deadline now = Clock::now();
        if (inner_->receive(message, std::min(deadline, now + between_looks))) return true;
        if (now >= deadline) return false;
        look_();
      }
    });
  }

 private:
  template <typename Try>
  bool or_lost(Try&& attempt) {
    try {
      return attempt();
    } catch (const PeerError& lost) {
      const Deadline end = Clock::now() + patience_after_a_loss;
      while (Clock::now() < end) {
        look_();
        std::this_thread::sleep_for(between_looks);
      }
      throw PeerError(lost.peer(), lost.text() + advice);
    }
  }

  std::unique_ptr<ZmqChannel> inner_;
  WhileWaiting look_;
};

class DirectDataPath final : public DataPath {
 public:
  DirectDataPath(std::unique_ptr<ZmqChannel> channel, wire::Role role, WhileWaiting look)
      : channel_(std::move(channel), std::move(look)), messages_(channel_, other_side(role)) {}

  wire::MessageChannel& messages() override { return messages_; }
  bool wants_copies() const override { return true; }

 private:
  Looking channel_;
  wire::MessageChannel messages_;
};

/// An address where there is one: a name is not known everywhere, and not at every moment to a container's resolver.
std::string reachable_host(const DirectOptions& options) {
  if (const auto address = transport::local_address_towards(options.orchestrator)) return *address;
  std::array<char, 256> host{};
  return ::gethostname(host.data(), host.size() - 1) == 0 ? host.data() : "localhost";
}

[[noreturn]] void refuse(wire::Role role, const std::string& endpoint, const DirectOptions& options,
                         const std::string& why) {
  throw PeerError(other_side(role), "no direct connection over " + endpoint + " within " +
                                        rounded_text(options.connect_deadline_s) + " s" + why + advice);
}

}  // namespace

DirectDoor::DirectDoor(const DirectOptions& options)
    : options_(options),
      channel_(ZmqChannel::bind(options.listen, zmq_options(options, options.listen, wire::STRUCTURE))) {}

DirectDoor::~DirectDoor() = default;

std::string DirectDoor::endpoint() const {
  std::string endpoint = channel_->endpoint();
  const std::string everywhere = "tcp://0.0.0.0:";
  if (!endpoint.starts_with(everywhere)) return endpoint;
  return "tcp://" + reachable_host(options_) + ":" + endpoint.substr(everywhere.size());
}

std::unique_ptr<DataPath> DirectDoor::open(WhileWaiting look) && {
  const Deadline end = transport::in(std::chrono::duration<double>(options_.connect_deadline_s));
  while (!channel_->wait_for_peer(Clock::now() + between_looks)) {
    look();
    if (Clock::now() >= end) refuse(wire::STRUCTURE, channel_->endpoint(), options_, ": nobody came");
  }
  return std::make_unique<DirectDataPath>(std::move(channel_), wire::STRUCTURE, std::move(look));
}

std::unique_ptr<DataPath> connect_directly(const std::string& endpoint, const DirectOptions& options,
                                           const WhileWaiting& look) {
  const Deadline end = transport::in(std::chrono::duration<double>(options.connect_deadline_s));
  while (true) {
    try {
      return std::make_unique<DirectDataPath>(ZmqChannel::connect(endpoint, std::min(end, Clock::now() + an_attempt),
                                                                  zmq_options(options, endpoint, wire::IMPACTOR)),
                                              wire::IMPACTOR, look);
    } catch (const PeerError& error) {
      look();
      if (Clock::now() >= end) refuse(wire::IMPACTOR, endpoint, options, ": " + error.text());
    }
  }
}

}  // namespace grainstep::participant
