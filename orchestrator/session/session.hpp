/// @file A run as a conversation: introductions, models, agreed steps, the lock step, the end.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "grainstep/scene.pb.h"
#include "orchestrator/session/check_ready.hpp"
#include "orchestrator/session/hub.hpp"
#include "orchestrator/session/lock_step.hpp"
#include "orchestrator/session/step_observer.hpp"
#include "orchestrator/session/step_plan.hpp"

namespace grainstep::orchestrator {

/// The way of Forces and Kinematics (proto/README.md, "The path of data").
enum class Path {
  hub,       ///< through the orchestrator
  shared,    ///< through memory that the sides share
  direct,    ///< over a connection between them
  shortest,  ///< the first of shared (on one host), direct, hub that both sides can take, and the host has
};

/// The word of --path.
[[nodiscard]] const char* text_of(Path path);

/// What a session needs to know of a scene.
struct Task {
  const scene::Scene& scene;
  std::uint64_t hash = 0;
  double end = 0.0;      ///< s
  bool preview = false;  ///< nothing will be started: only what the sides say before is wanted
  Path path = Path::hub;
  bool one_host = true;                               ///< as far as anybody knows
  const Checkpoint* resume = nullptr;                 ///< what to go on from; the start
  std::function<bool(std::uint64_t)> save_when = {};  ///< LockStep::save_when()
};

/// Order of calls: introduce, prepare, run (of a preview: introduce, ask, end); and at any time after construction,
/// when one of them threw, abandon. It does not matter to a session whether its channels lead to processes or to
/// threads.
class Session {
 public:
  Session(Hub& hub, const Task& task, const Deadlines& deadlines) : hub_(hub), task_(task), deadlines_(deadlines) {}

  /// Both Hellos, checked. PeerError names whoever did not come.
  void introduce();

  /// Setup and Ready: the structure first, because the impactor is told its surface. Agrees on the steps.
  [[nodiscard]] StepPlan prepare();

  /// The same of those sides that are there (not finished from the start), without steps.
  void ask();
  /// Stop in place of Start, Finished.
  void end();

  /// Start, all windows, Stop, Finished.
  void run(const StepPlan& plan, StepObserver& observer);

  /// Which one run() takes; hub before.
  [[nodiscard]] Path path() const { return path_; }

  /// Asks both sides, but for `lost` (a peer's name, or empty), to stop and waits a little for their answers. What they
  /// had reported before is still handed to run()'s observer, which has to be there until this returns.
  void abandon(const std::string& reason, const std::string& lost) noexcept;

 private:
  [[nodiscard]] Demands demands_of(const Peer& peer) const;
  wire::Setup setup() const;
  void make_ready(Peer& peer, wire::Setup& setup);
  void send_setup(Peer& peer, wire::Setup& setup);
  void stop_sides(const std::string& reason);
  void tell_to_stop(const std::string& reason);
  [[nodiscard]] bool finished() { return hub_.impactor().finished && hub_.structure().finished; }
  void lose(const std::string& name);
  void hear_the_rest(Peer& peer, const wire::Frame& frame);
  /// Says in `start` which way Forces and Kinematics take. InputError where the task's path cannot be had.
  void choose_path(wire::Start& start);
  [[nodiscard]] bool share(wire::Start& start);    ///< false: one side cannot, or the host gives no memory
  [[nodiscard]] bool connect(wire::Start& start);  ///< false: one side cannot

  Hub& hub_;
  Task task_;
  Deadlines deadlines_;
  Path path_ = Path::hub;
  std::unique_ptr<Listener> listener_;
  std::optional<LockStep> steps_;  // hears through it
};

}  // namespace grainstep::orchestrator
