/// @file Two connected channels inside one process, for tests and for runs that compare processes with none.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "transport/channel.hpp"

namespace grainstep::transport {

/// Names that appear in the PeerErrors of the other end.
struct PairNames {
  std::string first = "first peer";
  std::string second = "second peer";
};

/// Makes two ends that may live in two threads. Buffers circulate between sender, queue and receiver, so that a steady
/// exchange does not allocate. Destroying one end is the loss of that peer for the other.
[[nodiscard]] std::pair<std::unique_ptr<Channel>, std::unique_ptr<Channel>> make_in_process_pair(PairNames names = {});

}  // namespace grainstep::transport
