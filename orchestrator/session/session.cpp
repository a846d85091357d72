#include "orchestrator/session/session.hpp"

#include <algorithm>
#include <string>
#include <system_error>

#include "base/error.hpp"
#include "participant/data_path.hpp"
#include "participant/direct_path.hpp"
#include "scene/groups.hpp"
#include "wire/state_parts.hpp"

namespace grainstep::orchestrator {
namespace {

bool can(const Peer& peer, const char* capability) {
  return std::ranges::count(peer.hello.capabilities(), capability) > 0;
}

[[noreturn]] void refuse_path(const std::string& path, const std::string& why) {
  throw InputError("--path " + path + ": " + why + "; --path hub takes another way");
}

}  // namespace

const char* text_of(Path path) {
  switch (path) {
    case Path::hub:
      return "hub";
    case Path::shared:
      return "shared";
    case Path::direct:
      return "direct";
    case Path::shortest:
      break;
  }
  return "auto";
}

Demands Session::demands_of(const Peer& peer) const {
  return {.dimension = scene::surface_dimension(task_.scene),
          .needs = scene::needs(task_.scene, peer.role),
          .scene_hash = task_.hash,
          .preview = task_.preview,
          .of_revolution = task_.scene.symmetry() == scene::SYMMETRY_AXISYMMETRIC};
}

void Session::introduce() {
  const auto handler = [this](Peer& peer, const wire::Frame& frame) {
    peer.messages.take(frame, peer.hello);
    check_hello(peer, demands_of(peer));
    peer.introduced = true;
  };
  Peer& impactor = hub_.impactor();
  Peer& structure = hub_.structure();
  const auto done = [&] { return impactor.introduced && structure.introduced; };
  const double patience = deadlines_.connect_s;  // what is waited and what is said are one number, here and below
  if (!hub_.run(handler, done, Hub::within(patience))) {
    const std::string who = impactor.introduced    ? structure.name()
                            : structure.introduced ? impactor.name()
                                                   : impactor.name() + " and " + structure.name();
    throw PeerError(who, "did not connect within " + std::to_string(static_cast<int>(patience)) +
                             " s. Is it started with the right address? --connect-deadline waits longer.");
  }
}

wire::Setup Session::setup() const {
  wire::Setup out;
  out.set_protocol(wire::PROTOCOL_VERSION);
  out.set_scene_hash(task_.hash);
  out.set_symmetry(task_.scene.symmetry());
  out.set_depth(task_.scene.depth());
  out.set_mirror(scene::has_mirror(task_.scene));
  out.set_dimension(scene::surface_dimension(task_.scene));
  out.set_preview(task_.preview);
  return out;
}

/// With the state to go on from, if there is one.
void Session::send_setup(Peer& peer, wire::Setup& setup) {
  if (task_.resume == nullptr) return hub_.send(peer, setup);
  const std::string& state = peer.role == wire::IMPACTOR ? task_.resume->impactor : task_.resume->structure;
  setup.mutable_restore()->set_window(task_.resume->window);
  setup.mutable_restore()->set_chunks(wire::state_parts(state.size()));
  hub_.send(peer, setup);
  wire::send_state(peer.messages, task_.resume->window, state);
}

void Session::make_ready(Peer& peer, wire::Setup& setup) {
  send_setup(peer, setup);
  bool ready = false;
  const auto handler = [&](Peer& from, const wire::Frame& frame) {
    if (&from != &peer) {
      from.messages.refuse("nothing before its turn", frame);
    }
    from.messages.take(frame, from.ready);
    ready = true;
  };
  const double patience = deadlines_.step_s;
  if (!hub_.run(
          handler, [&] { return ready; }, Hub::within(patience))) {
    throw PeerError(peer.name(), "did not prepare its model within " + std::to_string(static_cast<int>(patience)) +
                                     " s; --step-deadline waits longer");
  }
  check_ready(peer, demands_of(peer));
}

void Session::ask() {
  wire::Setup for_structure = setup();
  *for_structure.mutable_structure()->mutable_structure() = task_.scene.structure();
  *for_structure.mutable_structure()->mutable_guards() = task_.scene.guards();
  if (!hub_.structure().finished) make_ready(hub_.structure(), for_structure);
  if (hub_.impactor().finished) return;

  wire::Setup for_impactor = setup();
  *for_impactor.mutable_impactor()->mutable_impactor() = task_.scene.impactor();
  *for_impactor.mutable_impactor()->mutable_guards() = task_.scene.guards();
  *for_impactor.mutable_impactor()->mutable_surface() = hub_.structure().ready.surface();
  for_impactor.mutable_impactor()->set_free_mass(hub_.structure().ready.free_mass());
  make_ready(hub_.impactor(), for_impactor);
}

StepPlan Session::prepare() {
  ask();
  return plan_steps(task_.scene, task_.end, steps_of(hub_.impactor().ready), steps_of(hub_.structure().ready));
}

bool Session::share(wire::Start& start) {
  const bool must = task_.path == Path::shared;
  for (const Peer* peer : {&hub_.impactor(), &hub_.structure()}) {
    if (can(*peer, participant::shared_memory_capability)) continue;
    if (!must) return false;
    refuse_path("shared",
                "the " + peer->name() + " (" + peer->hello.backend() + ") cannot share memory with the other side");
  }
  try {
    listener_ =
        std::make_unique<Listener>(static_cast<std::uint64_t>(hub_.structure().ready.surface().position_size()));
  } catch (const std::system_error& error) {
    if (!must) return false;
    refuse_path("shared", std::string("this host gives no memory to share: ") + error.what());
  }
  start.mutable_shared_memory()->set_file(listener_->file());
  path_ = Path::shared;
  return true;
}

bool Session::connect(wire::Start& start) {
  for (const Peer* peer : {&hub_.impactor(), &hub_.structure()}) {
    if (can(*peer, participant::direct_capability)) continue;
    if (task_.path != Path::direct) return false;
    refuse_path("direct", "the " + peer->name() + " (" + peer->hello.backend() + ") " +
                              (peer->role == wire::IMPACTOR
                                   ? "cannot connect to the structure"
                                   : "does not listen for the impactor (one of ours does with --data-listen)"));
  }
  start.mutable_direct()->set_endpoint(hub_.structure().hello.data_endpoint());
  path_ = Path::direct;
  return true;
}

void Session::choose_path(wire::Start& start) {
  const bool shortest = task_.path == Path::shortest;
  if ((task_.path == Path::shared || (shortest && task_.one_host)) && share(start)) return;
  if (task_.path == Path::direct || shortest) static_cast<void>(connect(start));
}

void Session::run(const StepPlan& plan, StepObserver& observer) {
  wire::Start start = plan.start();
  choose_path(start);
  if (task_.resume != nullptr) start.set_first_window(task_.resume->window + 1);
  hub_.send(hub_.structure(), start);
  hub_.send(hub_.impactor(), start);
  steps_.emplace(hub_, observer, start, deadlines_.step_s, listener_.get());
  if (task_.resume != nullptr) steps_->go_on_from(task_.resume->surface);
  steps_->save_when(task_.save_when);
  steps_->run();
  observer.finish();
  stop_sides("complete");
}

void Session::end() { stop_sides("only asked"); }

void Session::stop_sides(const std::string& reason) {
  wire::Stop message;
  message.set_reason(reason);
  for (Peer* peer : {&hub_.impactor(), &hub_.structure()}) {
    if (!peer->finished) hub_.send(*peer, message);
  }
  const auto handler = [](Peer& peer, const wire::Frame& frame) {
    wire::Finished last;
    peer.messages.take(frame, last);
    peer.timing = last.timing();
    peer.finished = true;
  };
  const double patience = deadlines_.step_s;
  if (!hub_.run(
          handler, [this] { return finished(); }, Hub::within(patience))) {
    throw PeerError(hub_.impactor().finished ? hub_.structure().name() : hub_.impactor().name(),
                    "did not answer Stop within " + std::to_string(static_cast<int>(patience)) + " s");
  }
}

void Session::lose(const std::string& name) {
  for (Peer* peer : {&hub_.impactor(), &hub_.structure()}) {
    peer->finished = peer->finished || peer->name() == name;
  }
}

void Session::tell_to_stop(const std::string& reason) {
  wire::Stop message;
  message.set_reason(reason);
  message.set_abandoned(true);
  for (Peer* peer : {&hub_.impactor(), &hub_.structure()}) {
    try {
      // Who has not said Hello may not be there at all, and sending would wait for it.
      peer->finished = peer->finished || !peer->introduced;
      if (!peer->finished) {
        peer->messages.send(message);
      }
    } catch (const PeerError&) {
      lose(peer->name());
    }
  }
}

// One side's failure may overtake what the other has said of the windows before it. Without these reports the last rows
// of a failed run would depend on who was quicker.
void Session::hear_the_rest(Peer& peer, const wire::Frame& frame) {
  wire::Finished last;
  if (wire::parse(frame, last)) {
    peer.timing = last.timing();
    peer.finished = true;
  } else if (steps_) {
    steps_->late(peer, frame);
  }
}

// The run has failed already and its reason is known. A peer that cannot be told any more ends with its channel or with
// its process; no further failure may keep the other one from being told.
void Session::abandon(const std::string& reason, const std::string& lost) noexcept {
  try {
    lose(lost);
    tell_to_stop(reason);
    const Hub::Until until = Hub::within(deadlines_.stop_s);
    const auto handler = [this, &until](Peer& peer, const wire::Frame& frame) {
      // Who never stops talking does not keep us from coming to an end.
      if (transport::Clock::now() >= until()) throw PeerError(peer.name(), "goes on talking after Stop");
      hear_the_rest(peer, frame);
    };
    while (!finished() && transport::Clock::now() < until()) {
      try {
        static_cast<void>(hub_.run(
            handler, [this] { return finished(); }, until));
      } catch (const PeerError& error) {
        lose(error.peer());
      } catch (const InputError&) {      // an Error that crossed our Stop: it was that peer's last message
      } catch (const NumericalError&) {  // the same, or a late row is beyond a limit
      } catch (const OutputError&) {     // a late row cannot be written
      }
    }
  } catch (...) {  // an interrupt, or the system refuses to wait: both were told, and that has to do
  }
}

}  // namespace grainstep::orchestrator
