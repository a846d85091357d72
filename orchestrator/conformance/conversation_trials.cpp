#include <algorithm>
#include <thread>

#include "base/error.hpp"
#include "orchestrator/conformance/played.hpp"
#include "orchestrator/conformance/trial.hpp"
#include "orchestrator/session/check_ready.hpp"
#include "scene/load.hpp"

namespace grainstep::conformance {
namespace {

using orchestrator::Demands;

Demands demands_of(const Bench& bench) {
  return {.dimension = scene::surface_dimension(bench.scene),
          .needs = scene::needs(bench.scene, bench.role),
          .scene_hash = scene::scene_hash(bench.scene)};
}

/// The orchestrator's own checks, as breaches.
template <class Check>
void hold_to(Check check) {
  try {
    check();
  } catch (const PeerError& error) {
    throw Breach(error.text());
  } catch (const InputError& error) {
    throw Breach(error.what());
  }
}

void hello(const Bench& bench) {
  Subject subject(bench);
  subject.introduce();
  hold_to([&] { orchestrator::check_hello(subject.peer(), demands_of(bench)); });
  const wire::Hello& said = subject.peer().hello;
  if (said.backend().empty()) throw Breach("Hello.backend is empty: people would not know what it is");
  subject.stop();
}

void ready(const Bench& bench) {
  Subject subject(bench);
  subject.introduce();
  subject.prepare(flat_surface(bench));
  hold_to([&] { orchestrator::check_ready(subject.peer(), demands_of(bench)); });
  subject.stop();
}

void preview(const Bench& bench) {
  Subject asked(bench);
  asked.introduce();
  asked.prepare(flat_surface(bench), true);
  hold_to([&] { orchestrator::check_ready(asked.peer(), demands_of(bench)); });
  asked.stop();
  Subject built(bench);
  built.introduce();
  built.prepare(flat_surface(bench));
  built.stop();
  const wire::Ready& one = asked.peer().ready;
  const wire::Ready& other = built.peer().ready;
  if (one.size() != other.size()) {
    throw Breach("counts " + std::to_string(one.size()) + " in a preview and " + std::to_string(other.size()) +
                 " when it builds its model");
  }
  if (one.surface().position_size() != other.surface().position_size() ||
      !std::ranges::equal(one.surface().facet(), other.surface().facet())) {
    throw Breach("shows another surface in a preview than when it builds its model");
  }
}

void stop_before_setup(const Bench& bench) {
  Subject subject(bench);
  subject.introduce();
  subject.stop();
}

void stop_before_start(const Bench& bench) {
  Subject subject(bench);
  subject.introduce();
  subject.prepare(flat_surface(bench));
  subject.stop();
}

void stop_in_the_middle(const Bench& bench) {
  Subject subject(bench);
  Played run(subject, bench, {.windows = 1'000});
  run.begin();
  for (int window = 0; window < 3; ++window) run.step();
  subject.stop();
}

void require_protocol_error(Subject& subject, const std::string& of) {
  const auto error = subject.hear_error();
  if (!error) throw Breach("no Error after " + of);
  if (error->kind() != wire::Error::PROTOCOL) {
    throw Breach("answers " + of + " with an Error of kind " + wire::Error::Kind_Name(error->kind()) +
                 ", expected PROTOCOL");
  }
  if (error->text().empty()) throw Breach("its Error about " + of + " has no text");
  if (const int code = subject.exit_code(); code != static_cast<int>(ExitCode::peer)) {
    throw Breach("ends with exit code " + std::to_string(code) + " after " + of + ", expected 4");
  }
}

void another_version(const Bench& bench) {
  Subject subject(bench);
  subject.introduce();
  wire::Setup setup = subject.setup(flat_surface(bench), false);
  setup.set_protocol(wire::PROTOCOL_VERSION + 1);
  subject.tell(setup);
  require_protocol_error(subject, "a Setup of another protocol version");
}

void out_of_order(const Bench& bench) {
  Subject subject(bench);
  subject.introduce();
  subject.tell(wire::Start());
  require_protocol_error(subject, "Start in place of Setup");
}

void damaged_frame(const Bench& bench) {
  Subject subject(bench);
  subject.introduce();
  const std::array<std::byte, 40> nonsense{};
  subject.tell_bytes(nonsense);
  require_protocol_error(subject, "a frame without the magic number");
}

void another_window(const Bench& bench) {
  Subject subject(bench);
  Played run(subject, bench, {.windows = 100});
  run.begin();
  run.step();
  run.tell_wrong_window();
  require_protocol_error(subject, "data of another window than the next");
}

void wrong_length(const Bench& bench) {
  Subject subject(bench);
  Played run(subject, bench, {.windows = 100});
  run.begin();
  run.step();
  run.tell_wrong_length();
  require_protocol_error(subject, "data with a number too many");
}

void silence(const Bench& bench) {
  Subject subject(bench);
  Played run(subject, bench, {.windows = 4});
  run.begin();
  run.step();
  std::this_thread::sleep_for(std::chrono::seconds(3));  // the silence itself: three heartbeats long
  while (!run.over()) run.step();
  subject.stop();
}

void loss(const Bench& bench) {
  Subject subject(bench);
  Played run(subject, bench, {.windows = 1'000});
  run.begin();
  run.step();
  subject.break_the_connection();
  if (const int code = subject.exit_code(); code != static_cast<int>(ExitCode::peer)) {
    throw Breach("ends with exit code " + std::to_string(code) + " when the orchestrator is lost, expected 4");
  }
}

}  // namespace

std::vector<Trial> conversation_trials() {
  return {
      {"hello", "Its first message is Hello: version, role, dimensions, and what the scene needs it can do.", "Order",
       hello},
      {"ready", "It answers Setup with Ready: the scene's hash, usable steps, numbers and surface.", "Ready", ready},
      {"preview", "A preview counts what the model will have, on the same surface.", "Preview", preview},
      {"stop_before_setup", "Stop in place of Setup: Finished, exit code 0.", "Order", stop_before_setup},
      {"stop_before_start", "Stop in place of Start: Finished, exit code 0.", "Order", stop_before_start},
      {"stop_in_the_middle", "Stop in the middle of a run: Finished, exit code 0.", "Order", stop_in_the_middle},
      {"another_version", "A Setup of another protocol version is refused.", "Versions", another_version},
      {"out_of_order", "A message out of order is refused: Error PROTOCOL, exit code 4.", "Errors and deadlines",
       out_of_order},
      {"damaged_frame", "A damaged frame is refused: Error PROTOCOL, exit code 4.", "Frame", damaged_frame},
      {"another_window", "Data of another window than the next are refused.", "Messages", another_window},
      {"wrong_length", "Data of another length than nodes x dimension are refused.", "Messages", wrong_length},
      {"silence", "Some seconds of silence end nothing.", "Errors and deadlines", silence},
      {"loss", "It ends by itself when the orchestrator is lost, with exit code 4.", "Connection", loss},
  };
}

std::vector<Trial> trials_of(wire::Role role) {
  std::vector<Trial> all = conversation_trials();
  for (Trial& one : role == wire::STRUCTURE ? structure_trials() : impactor_trials()) all.push_back(std::move(one));
  return all;
}

}  // namespace grainstep::conformance
