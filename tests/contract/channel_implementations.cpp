#include <future>

#include "base/temporary_directory.hpp"
#include "channel_contract.hpp"
#include "patience.hpp"
#include "transport/in_process_channel.hpp"
#include "transport/zmq_channel.hpp"

namespace grainstep::transport::testing {
namespace {

ConnectedPair in_process() {
  auto [left, right] = make_in_process_pair();
  return {nullptr, std::move(left), std::move(right)};
}

/// The binding end admits the other while it waits, so that one connects from a second thread.
ConnectedPair zmq_pair(const std::string& endpoint, const ZmqOptions& options, std::shared_ptr<void> surroundings) {
  const Deadline deadline = grainstep::testing::soon();
  auto left = ZmqChannel::bind(endpoint, options);
  auto connecting =
      std::async(std::launch::async, [&] { return ZmqChannel::connect(left->endpoint(), deadline, options); });
  if (!left->wait_for_peer(deadline)) {
    throw std::runtime_error("no peer on " + left->endpoint());
  }
  return {std::move(surroundings), std::move(left), connecting.get()};
}

ConnectedPair ipc() {
  auto directory = std::make_shared<TemporaryDirectory>();
  return zmq_pair("ipc://" + (directory->path() / "channel").string(), {}, directory);
}

ConnectedPair tcp() { return zmq_pair("tcp://127.0.0.1:*", {}, nullptr); }

ConnectedPair tcp_curve() {
  auto directory = std::make_shared<TemporaryDirectory>();
  make_keys(directory->path() / "keys");
  ZmqOptions options;
  options.curve_dir = directory->path() / "keys";
  return zmq_pair("tcp://127.0.0.1:*", options, directory);
}

}  // namespace

std::vector<Implementation> implementations() {
  return {{"in_process", in_process}, {"ipc", ipc}, {"tcp", tcp}, {"tcp_curve", tcp_curve}};
}

}  // namespace grainstep::transport::testing
