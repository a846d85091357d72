#include "orchestrator/session/check_ready.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "declare/suggest.hpp"
#include "ledger/message_numbers.hpp"
#include "participant/check_surface.hpp"
#include "participant/direct_path.hpp"
#include "transport/endpoint.hpp"

namespace grainstep::orchestrator {
namespace {

constexpr std::size_t longest_endpoint = 1000;
constexpr int digits = 4;  // of times and steps, in messages

[[noreturn]] void refuse(const Peer& peer, const std::string& text) { throw PeerError(peer.name(), text); }

void check_steps(const Peer& peer) {
  const double stable = peer.ready.stable_step();
  const double preferred = peer.ready.preferred_step();
  if (!(stable > 0.0) || !(preferred > 0.0)) {
    refuse(peer, "gives a stable step of " + rounded_text(stable, digits) + " s and prefers " +
                     rounded_text(preferred, digits) + " s; both must be above zero");
  }
  if (preferred > stable) {
    refuse(peer, "prefers a step of " + rounded_text(preferred, digits) + " s, but is stable only up to " +
                     rounded_text(stable, digits) + " s");
  }
}

void check_not_negative(const Peer& peer) {
  const wire::Ready& r = peer.ready;
  const std::pair<const char*, double> numbers[] = {{"mass", r.mass()},
                                                    {"contact_mass", r.contact_mass()},
                                                    {"contact_time", r.contact_time()},
                                                    {"free_mass", r.free_mass()},
                                                    {"longest_window", r.longest_window()},
                                                    {"largest_particle", r.largest_particle()},
                                                    {"seconds_per_step", r.seconds_per_step()}};
  for (const auto& [name, value] : numbers) {
    if (!(value >= 0.0)) {
      refuse(peer, "Ready." + std::string(name) + " is " + rounded_text(value, digits) +
                       "; it must be 0 (not known) or above");
    }
  }
}

/// Nodes of a surface of revolution are rings at (r, z): a facet on the axis, or beyond it, has no area.
void check_rings(const Peer& peer, const wire::Surface& surface) {
  for (int i = 0; i + 1 < surface.facet_size(); i += 2) {
    const double a = surface.position(2 * static_cast<int>(surface.facet(i)));
    const double b = surface.position(2 * static_cast<int>(surface.facet(i + 1)));
    if (a >= 0.0 && b >= 0.0 && a + b > 0.0) continue;
    refuse(peer, "Ready.surface: facet " + std::to_string(i / 2) + " reaches from r = " + rounded_text(a, digits) +
                     " m to " + rounded_text(b, digits) +
                     " m; a ring's radius is 0 or above, and one of the two above 0");
  }
}

void check_surface(const Peer& peer, const Demands& demands) {
  if (const auto found = participant::surface_problem(peer.ready.surface(), demands.dimension)) {
    refuse(peer, "Ready.surface" + *found);
  }
  if (demands.of_revolution) check_rings(peer, peer.ready.surface());
}

void check_data_endpoint(const Peer& peer) {
  const std::string& endpoint = peer.hello.data_endpoint();
  if (std::ranges::count(peer.hello.capabilities(), participant::direct_capability) == 0) return;
  if (peer.role == wire::IMPACTOR) return;
  try {
    if (endpoint.size() > longest_endpoint) throw InputError(std::to_string(endpoint.size()) + " characters");
    transport::check_form(endpoint, transport::Use::connect);
  } catch (const InputError& error) {
    refuse(peer, std::string("Hello.data_endpoint: ") + error.what());
  }
}

}  // namespace

void check_hello(const Peer& peer, const Demands& demands) {
  const wire::Hello& hello = peer.hello;
  const std::string& who = hello.backend();
  if (hello.protocol() != wire::PROTOCOL_VERSION) {
    refuse(peer, who + ": speaks protocol version " + std::to_string(hello.protocol()) + ", this program version " +
                     std::to_string(wire::PROTOCOL_VERSION) + ": update the older one");
  }
  if (hello.role() != peer.role) {
    refuse(peer, who + ": says that it is the " + wire::Role_Name(hello.role()) + ", the " +
                     wire::Role_Name(peer.role) + " was expected: it was started with the other side's address");
  }
  if (std::ranges::find(hello.dimension(), demands.dimension) == hello.dimension().end()) {
    std::vector<std::string> known;
    for (const unsigned one : hello.dimension()) known.push_back(std::to_string(one));
    throw InputError("symmetry: the scene has " + std::to_string(demands.dimension) + " dimensions, but the " +
                     peer.name() + " (" + who + ") computes in " +
                     (known.empty() ? "none" : declare::join_words(known)));
  }
  check_data_endpoint(peer);
  const std::vector<std::string> words(hello.capabilities().begin(), hello.capabilities().end());
  for (const scene::Need& need : demands.needs) {
    if (std::ranges::find(words, need.word) != words.end()) continue;
    throw InputError(need.key + ": asks for '" + need.word + "', which the " + peer.name() + " (" + who +
                     ") does not say it can compute; its capabilities: " +
                     (words.empty() ? std::string("none") : declare::join_words(words)));
  }
}

void check_ready(const Peer& peer, const Demands& demands) {
  const wire::Ready& ready = peer.ready;
  if (ready.scene_hash() != demands.scene_hash) {
    refuse(peer, "prepared scene " + std::to_string(ready.scene_hash()) + ", this run is of scene " +
                     std::to_string(demands.scene_hash));
  }
  if (const auto found = ledger::first_not_finite(ready)) refuse(peer, "Ready." + *found + "; it must be a number");
  check_steps(peer);
  check_not_negative(peer);
  if (ready.ledger() != wire::FULL && ready.ledger() != wire::INTERFACE) {
    refuse(peer,
           "Ready.ledger is not said: FULL (energy and momentum of all that it models) or INTERFACE (only what "
           "passes through the surface)");
  }
  if (peer.role == wire::STRUCTURE) check_surface(peer, demands);
}

}  // namespace grainstep::orchestrator
