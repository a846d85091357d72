/// @file How a participant finds its orchestrator. A program of its own takes these options from its command line
/// (program.hpp).
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "transport/channel.hpp"

namespace grainstep::participant {

struct ConnectOptions {
  std::string endpoint;                  ///< "ipc:///path" or "tcp://host:port"
  std::filesystem::path curve_dir = {};  ///< participant.key and orchestrator.pub (transport/curve.hpp); empty: plain
  double connect_deadline_s = 120.0;
  bool allow_plain_tcp = false;
  std::string data_listen = {};  ///< where a structure listens for its impactor (direct_path.hpp); empty: nowhere
};

/// The channel to the orchestrator. Tries until somebody answers; PeerError (exit code 4) when nobody does within the
/// deadline, InputError (exit code 2) for an endpoint or keys that cannot be used.
[[nodiscard]] std::unique_ptr<transport::Channel> open(const ConnectOptions& options);

}  // namespace grainstep::participant
