#include "participant/conversation.hpp"

#include <unistd.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/processor_time.hpp"
#include "participant/check_start.hpp"
#include "participant/check_surface.hpp"
#include "participant/data_path.hpp"
#include "wire/state_parts.hpp"

namespace grainstep::participant {
namespace {

std::string seconds_text(double seconds) { return rounded_text(seconds) + " s"; }

/// An impactor that is asked for a preview may be asked without a surface (proto/README.md).
std::optional<std::string> problem_of_surface(const wire::Setup& setup) {
  const wire::Surface& surface = setup.impactor().surface();
  if (setup.preview() && surface.position().empty() && surface.facet().empty()) return std::nullopt;
  return surface_problem(surface, setup.dimension());
}

double seconds_of(transport::Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// The orchestrator says Stop while data take another path.
class Stopped {};

constexpr auto between_looks = std::chrono::milliseconds(2);  // at the orchestrator, while data come

constexpr const char* state_capability = "state";
constexpr std::size_t largest_state = std::size_t{1} << 40U;  // bytes; the orchestrator has it in a file

}  // namespace

Conversation::Conversation(transport::Channel& channel, const ServeOptions& options)
    : messages_(channel, "orchestrator"), options_(options) {}

Conversation::~Conversation() = default;

bool Conversation::introduce(wire::Hello hello, wire::Role role, wire::Setup& setup) {
  hello.set_protocol(wire::PROTOCOL_VERSION);
  hello.set_role(role);
  role_ = role;
  offer_data_paths(hello);
  can_save_ = std::ranges::count(hello.capabilities(), state_capability) > 0;
  hello.set_process(static_cast<std::uint64_t>(::getpid()));
  messages_.send(hello);
  const wire::Frame* frame = next("Setup", options_.setup_deadline_s);
  if (frame == nullptr) {
    return false;
  }
  messages_.take(*frame, setup);
  preview_ = setup.preview();
  if (setup.protocol() != wire::PROTOCOL_VERSION) {
    refuse("Setup names protocol version " + std::to_string(setup.protocol()) + ", this program speaks " +
           std::to_string(wire::PROTOCOL_VERSION));
  }
  const auto part = role == wire::STRUCTURE ? wire::Setup::kStructure : wire::Setup::kImpactor;
  if (setup.part_case() != part) {
    refuse("Setup does not hold the part of the scene for this participant, role " + wire::Role_Name(role));
  }
  if (role == wire::IMPACTOR) {
    if (const auto found = problem_of_surface(setup)) refuse("Setup.impactor.surface" + *found);
  }
  return !setup.has_restore() || take_state(setup.restore());
}

bool Conversation::take_state(const wire::Restore& restore) {
  if (!can_save_) refuse("Setup is that of a run that continues, which this participant cannot");
  wire::StateParts parts(messages_.peer(), restore.window(), largest_state);
  wire::State part;
  while (parts.count() < restore.chunks()) {
    const wire::Frame* frame = next("State", options_.setup_deadline_s);
    if (frame == nullptr) return false;
    messages_.take(*frame, part, restore.window());
    parts.add(part);
  }
  restored_ = parts.take();
  restored_window_ = restore.window();
  return true;
}

void Conversation::send_state(std::uint64_t window, std::string_view state) {
  if (stopped_) return;
  wire::send_state(messages_, window, state);
  wire::Saved saved;
  saved.set_window(window);
  saved.set_chunks(wire::state_parts(state.size()));
  messages_.send(saved);
}

void Conversation::note_save(std::uint64_t window) {
  if (!can_save_) {
    refuse("Forces of window " + std::to_string(window) + " ask for a state, which this participant cannot give");
  }
  if (window < windows_) save_ = window;
}

bool Conversation::take_aside(const wire::Frame& frame) {
  if (frame.kind != wire::Envelope::kSave || role_ != wire::IMPACTOR || !can_save_) return false;
  save_wanted_ = true;
  return true;
}

void Conversation::send_forces(const wire::Forces& forces) {
  if (!save_wanted_ || forces.window() >= windows_) {
    return send_data([&](wire::MessageChannel& data) { data.send(forces); });
  }
  save_wanted_ = false;
  save_ = forces.window();
  wire::Forces marked = forces;
  marked.set_save(true);
  send_data([&](wire::MessageChannel& data) { data.send(marked); });
}

void Conversation::ready(wire::Ready ready, const wire::Setup& setup) {
  ready.set_scene_hash(setup.scene_hash());
  messages_.send(ready);
}

bool Conversation::wait_for_start(wire::Start& start) {
  const wire::Frame* frame = next("Start", options_.setup_deadline_s);
  if (frame == nullptr) {
    return false;
  }
  if (preview_) messages_.refuse("Stop after the Ready of a preview, for which no model was built", *frame);
  messages_.take(*frame, start);
  if (const auto found = start_problem(start)) refuse(*found);
  const std::uint64_t first = restored_ ? restored_window_ + 1 : 0;
  if (start.first_window() != first) {
    refuse("Start begins at window " + std::to_string(start.first_window()) + ", expected " + std::to_string(first) +
           (restored_ ? ", the one after the state's" : ": no state was given to go on from"));
  }
  windows_ = start.windows();
  try {
    open_data_path(start);
  } catch (const Stopped&) {
    return false;
  }
  started_ = transport::Clock::now();
  processor_at_start_ = processor_seconds();
  return true;
}

const wire::Frame* Conversation::wait_for_data(const std::string& kind, std::uint64_t window) {
  const auto before = transport::Clock::now();
  const std::string expected = kind + " of window " + std::to_string(window);
  const wire::Frame* frame =
      data_ ? next_on_data_path(expected, options_.data_deadline_s) : next(expected, options_.data_deadline_s);
  waited_ += transport::Clock::now() - before;
  return frame;
}

const wire::Frame* Conversation::next(const std::string& expected, double deadline_s) {
  if (stopped_) {
    return nullptr;
  }
  const wire::Frame* frame = nullptr;
  do {
    frame = messages_.receive(transport::in(std::chrono::duration<double>(deadline_s)));
    if (frame == nullptr) refuse("expected " + expected + ", heard nothing for " + seconds_text(deadline_s));
  } while (take_aside(*frame));
  if (frame->kind == wire::Envelope::kStop) {
    stopped_ = true;
    return nullptr;
  }
  return frame;
}

wire::MessageChannel& Conversation::data() { return data_ ? data_->messages() : messages_; }

void Conversation::offer_data_paths(wire::Hello& hello) {
  if (options_.shared_memory) hello.add_capabilities(shared_memory_capability);
  if (!options_.direct) return;
  const std::string& listen = options_.direct->listen;
  if (role_ == wire::IMPACTOR) {
    if (!listen.empty()) {
      throw InputError("--data-listen " + listen + ": the structure listens, an impactor is told where; leave it out");
    }
    hello.add_capabilities(direct_capability);
  } else if (!listen.empty()) {
    door_ = std::make_unique<DirectDoor>(*options_.direct);
    hello.add_capabilities(direct_capability);
    hello.set_data_endpoint(door_->endpoint());
  }
}

void Conversation::open_data_path(const wire::Start& start) {
  const auto look = [this] { look_for_stop(); };
  if (start.has_shared_memory()) {
    data_ = share_memory(start.shared_memory().file(), role_, look);
  } else if (start.has_direct() && role_ == wire::IMPACTOR && options_.direct) {
    data_ = connect_directly(start.direct().endpoint(), *options_.direct, look);
  } else if (start.has_direct() && door_) {
    data_ = std::move(*door_).open(look);
  } else if (start.has_direct()) {
    refuse("Start names a direct path of data, which this participant did not offer");
  }
  door_.reset();
}

void Conversation::look_for_stop() {
  looked_ = transport::Clock::now();
  const wire::Frame* frame = messages_.receive(looked_);
  if (frame == nullptr || take_aside(*frame)) return;
  if (frame->kind != wire::Envelope::kStop) messages_.refuse("Stop: data do not come from here", *frame);
  stopped_ = true;
  throw Stopped();
}

const wire::Frame* Conversation::next_on_data_path(const std::string& expected, double deadline_s) {
  try {
    if (transport::Clock::now() - looked_ > between_looks) look_for_stop();
    const wire::Frame* frame = data_->messages().receive(transport::in(std::chrono::duration<double>(deadline_s)));
    if (frame == nullptr) refuse("expected " + expected + ", heard nothing for " + seconds_text(deadline_s));
    return frame;
  } catch (const Stopped&) {
    return nullptr;
  }
}

void Conversation::knock() {
  if (data_) data_->knock();
}

void Conversation::send_data(const std::function<void(wire::MessageChannel&)>& send) {
  try {
    send(data());
    if (data_ && data_->wants_copies()) send(messages_);  // after who waits for it has it
  } catch (const Stopped&) {                              // nobody wants it any more
  }
}

void Conversation::send_report(wire::Report& report) {
  steps_ = report.timing().steps();
  fill_timing(*report.mutable_timing());
  send(report);
}

void Conversation::fill_timing(wire::Timing& timing) const {
  const double waited = seconds_of(waited_);
  const bool started = started_ != transport::Clock::time_point{};
  timing.set_wait(waited);
  timing.set_compute(started ? seconds_of(transport::Clock::now() - started_) - waited : 0.0);
  timing.set_steps(steps_);
  timing.set_processor(started ? processor_seconds() - processor_at_start_ : 0.0);
}

void Conversation::finish() {
  if (const wire::Frame* frame = next("Stop", options_.data_deadline_s)) {
    messages_.refuse("Stop", *frame);
  }
  wire::Finished finished;
  fill_timing(*finished.mutable_timing());
  messages_.send(finished);
}

void Conversation::refuse(const std::string& text) const { throw PeerError(messages_.peer(), text); }

}  // namespace grainstep::participant
