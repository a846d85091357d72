#include "orchestrator/process/asking.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "orchestrator/process/participants.hpp"
#include "orchestrator/process/supervision.hpp"
#include "orchestrator/session/session.hpp"

namespace grainstep::orchestrator {
namespace {

constexpr std::chrono::milliseconds patience_at_the_end{2'000};  // of processes that have said Finished

/// A side that is not ours to start takes no part.
void leave_out(Peer& peer, bool external) { peer.introduced = peer.finished = external; }

std::optional<wire::Ready> answer_of(const Peer& peer, bool external) {
  return external ? std::nullopt : std::optional(peer.ready);
}

bool takes_threads(const Peer& peer) { return std::ranges::count(peer.hello.capabilities(), "threads") > 0; }

}  // namespace

Answers ask(const scene::Scene& scene, std::uint64_t hash, const RunOptions& options) {
  const bool no_impactor = is_external(wire::IMPACTOR, scene, options);
  const bool no_structure = is_external(wire::STRUCTURE, scene, options);
  if (no_impactor && no_structure) return {};
  RunOptions local = options;
  local.ranks = 1;
  local.listen.clear();
  const TemporaryDirectory logs;
  EventLoop loop;
  Participants participants(scene, local);
  Supervision supervision(loop);
  Hub hub(participants.impactor(), participants.structure(), loop, [&supervision, &hub] {
    supervision.watch({.impactor = {hub.impactor().introduced, hub.impactor().finished},
                       .structure = {hub.structure().introduced, hub.structure().finished}});
  });
  leave_out(hub.impactor(), no_impactor);
  leave_out(hub.structure(), no_structure);
  Session session(hub, {.scene = scene, .hash = hash, .preview = true}, options.deadlines);
  try {
    participants.start(supervision, logs.path(), Participants::Others::nothing);
    session.introduce();
    session.ask();
    session.end();
  } catch (const PeerError& error) {
    session.abandon(error.what(), error.peer());
    const std::string account = supervision.account_of(error.peer());
    throw PeerError(error.peer(), error.text() + (account.empty() ? "" : "; " + account));
  } catch (const std::exception& error) {
    session.abandon(error.what(), "");
    throw;
  }
  Answers answers{
      .impactor = answer_of(hub.impactor(), no_impactor),
      .structure = answer_of(hub.structure(), no_structure),
      .takes_threads = {.impactor = takes_threads(hub.impactor()), .structure = takes_threads(hub.structure())}};
  supervision.end_all(patience_at_the_end);
  return answers;
}

}  // namespace grainstep::orchestrator
