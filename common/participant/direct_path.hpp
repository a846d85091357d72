/// @file The direct path of data: a connection between the two participants, on one host or two. The structure listens
/// and says where in its Hello; the impactor is told in Start.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "participant/data_path.hpp"

namespace grainstep::transport {
class ZmqChannel;
}

namespace grainstep::participant {

inline constexpr const char* direct_capability = "direct";  ///< the word in Hello

struct DirectOptions {
  std::string listen;  ///< ipc:///PATH or tcp://HOST:PORT, of a structure; empty: it has no such path to offer
  std::filesystem::path curve_dir = {};  ///< participant.key, which both sides share; empty: not encrypted
  bool allow_plain_tcp = false;
  double connect_deadline_s = 60.0;  ///< from Start until the other side is there
  std::string orchestrator = {};     ///< its endpoint: who is reached from there listens on all interfaces
};

/// Where a structure listens, from before its Hello until its impactor has come.
class DirectDoor {
 public:
  /// InputError for an endpoint that cannot be had, or that would carry data in the clear across a network.
  explicit DirectDoor(const DirectOptions& options);
  DirectDoor(const DirectDoor&) = delete;
  DirectDoor& operator=(const DirectDoor&) = delete;
  ~DirectDoor();

  /// What Hello says. Of all interfaces it names the one that leads to the orchestrator, or the host where that is
  /// here.
  [[nodiscard]] std::string endpoint() const;

  /// Waits for the impactor; PeerError where it does not come.
  [[nodiscard]] std::unique_ptr<DataPath> open(WhileWaiting look) &&;

 private:
  DirectOptions options_;
  std::unique_ptr<transport::ZmqChannel> channel_;
};

/// The impactor's end. InputError as above, PeerError where nobody answers.
[[nodiscard]] std::unique_ptr<DataPath> connect_directly(const std::string& endpoint, const DirectOptions& options,
                                                         const WhileWaiting& look);

}  // namespace grainstep::participant
