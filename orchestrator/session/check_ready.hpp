/// @file What a participant says of itself before a run, looked at as a stranger would: every number before it is used
/// as one.
#pragma once

#include <string>
#include <vector>

#include "orchestrator/session/peer.hpp"
#include "scene/needs.hpp"

namespace grainstep::orchestrator {

/// What the run asks of one side.
struct Demands {
  unsigned dimension = 2;
  std::vector<scene::Need> needs;
  std::uint64_t scene_hash = 0;
  bool preview = false;
  bool of_revolution = false;  ///< the surface's nodes are rings
};

/// PeerError where the peer speaks another version or another role; InputError, which names the scene's key, for what
/// it does not compute.
void check_hello(const Peer& peer, const Demands& demands);

/// PeerError: what was found, what is expected.
void check_ready(const Peer& peer, const Demands& demands);

}  // namespace grainstep::orchestrator
