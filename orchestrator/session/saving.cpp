#include "orchestrator/session/saving.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace grainstep::orchestrator {
namespace {

/// Generous: what a side says of its memory is an estimate.
std::size_t most_bytes(const Peer& peer) {
  constexpr std::size_t at_least = std::size_t{1} << 30U;
  constexpr std::size_t at_most = std::size_t{1} << 40U;
  return at_least + 16 * std::min<std::size_t>(peer.ready.memory(), at_most / 16);
}

bool can_save(const Peer& peer) { return std::ranges::count(peer.hello.capabilities(), "state") > 0; }

}  // namespace

bool Saving::possible() const { return can_save(hub_.impactor()) && can_save(hub_.structure()); }

void Saving::ask() {
  if (asked_) return;
  hub_.send(hub_.impactor(), wire::Save());
  asked_ = true;
}

void Saving::begin(std::uint64_t window, std::vector<double> surface) {
  if (!asked_ || impactor_) {
    throw PeerError(hub_.impactor().name(),
                    "Forces of window " + std::to_string(window) + " ask for states that nobody wants");
  }
  window_ = window;
  surface_ = std::move(surface);
  impactor_.emplace(Side{wire::StateParts(hub_.impactor().name(), window, most_bytes(hub_.impactor()))});
  structure_.emplace(Side{wire::StateParts(hub_.structure().name(), window, most_bytes(hub_.structure()))});
}

const Peer* Saving::owing() const {
  if (!holds_back()) return nullptr;
  return impactor_->saved ? &hub_.structure() : &hub_.impactor();
}

bool Saving::take(Peer& peer, const wire::Frame& frame) {
  if (frame.kind != wire::Envelope::kState && frame.kind != wire::Envelope::kSaved) return false;
  std::optional<Side>& of = side(peer);
  if (!of || of->saved) peer.messages.refuse("nothing of a state, which nobody asked for", frame);
  if (frame.kind == wire::Envelope::kState) {
    wire::State part;
    peer.messages.take(frame, part, window_);
    of->parts.add(part);
    return true;
  }
  wire::Saved saved;
  peer.messages.take(frame, saved, window_);
  if (saved.chunks() != of->parts.count()) {
    throw PeerError(peer.name(), "Saved of window " + std::to_string(window_) + " counts " +
                                     std::to_string(saved.chunks()) + " parts, " + std::to_string(of->parts.count()) +
                                     " have come");
  }
  of->saved = true;
  return true;
}

std::optional<Checkpoint> Saving::completed() {
  if (!holds_back() || !impactor_->saved || !structure_->saved) return std::nullopt;
  Checkpoint out{.window = window_,
                 .impactor = impactor_->parts.take(),
                 .structure = structure_->parts.take(),
                 .surface = std::move(surface_)};
  impactor_.reset();
  structure_.reset();
  asked_ = false;
  return out;
}

}  // namespace grainstep::orchestrator
