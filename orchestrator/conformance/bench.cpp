#include "orchestrator/conformance/bench.hpp"

#include "base/error.hpp"
#include "orchestrator/conformance/trial.hpp"
#include "scene/groups.hpp"
#include "scene/load.hpp"
#include "scene/needs.hpp"

namespace grainstep::conformance {
namespace {

process::Command connecting(process::Command command, const std::string& endpoint) {
  command.arguments.insert(command.arguments.end(), {"--connect", endpoint});
  return command;
}

std::string seconds_text(double seconds) { return std::to_string(static_cast<int>(seconds)) + " s"; }

}  // namespace

Subject::Subject(const Bench& bench)
    : bench_(bench),
      channel_(transport::ZmqChannel::bind("ipc://" + (folder_.path() / "here").string())),
      peer_(bench.role, *channel_),
      dimension_(scene::surface_dimension(bench.scene)),
      process_(std::make_unique<process::ChildProcess>(
          "the participant", connecting(bench.command, channel_->endpoint()), folder_.path() / "log")) {}

std::string Subject::account() const {
  const std::string tail = process_->log_tail(3);
  return " (its process " + process_->describe_end() + (tail.empty() ? "" : "; it wrote: " + tail) + ")";
}

const wire::Frame& Subject::next(const std::string& expected) {
  const wire::Frame* frame = nullptr;
  try {
    frame = peer_.messages.receive(transport::in(std::chrono::duration<double>(bench_.patience_s)));
  } catch (const PeerError& error) {
    static_cast<void>(process_->wait(std::chrono::milliseconds(500)));
    throw Breach("instead of " + expected + ": " + error.text() + account());
  }
  if (frame == nullptr) throw Breach("no " + expected + " within " + seconds_text(bench_.patience_s) + account());
  if (frame->kind == wire::Envelope::kError) throw Breach("instead of " + expected + " came " + wire::describe(*frame));
  return *frame;
}

void Subject::introduce() {
  peer_.hello = hear<wire::Hello>();
  peer_.introduced = true;
}

wire::Setup Subject::setup(const wire::Surface& surface, bool preview) const {
  const scene::Scene& scene = bench_.scene;
  wire::Setup out;
  out.set_protocol(wire::PROTOCOL_VERSION);
  out.set_scene_hash(scene::scene_hash(scene));
  out.set_symmetry(scene.symmetry());
  out.set_depth(scene.depth());
  out.set_mirror(scene::has_mirror(scene));
  out.set_dimension(dimension_);
  out.set_preview(preview);
  if (bench_.role == wire::STRUCTURE) {
    *out.mutable_structure()->mutable_structure() = scene.structure();
    *out.mutable_structure()->mutable_guards() = scene.guards();
  } else {
    *out.mutable_impactor()->mutable_impactor() = scene.impactor();
    *out.mutable_impactor()->mutable_guards() = scene.guards();
    *out.mutable_impactor()->mutable_surface() = surface;
  }
  return out;
}

void Subject::prepare(const wire::Surface& surface, bool preview) {
  tell(setup(surface, preview));
  peer_.ready = hear<wire::Ready>();
}

std::optional<wire::Error> Subject::hear_error() {
  const auto end = transport::in(std::chrono::duration<double>(bench_.patience_s));
  try {
    while (const wire::Frame* frame = peer_.messages.receive(end)) {
      if (frame->kind != wire::Envelope::kError) continue;
      wire::Error error;
      peer_.messages.take(*frame, error);
      return error;
    }
  } catch (const PeerError&) {  // it is gone
  }
  return std::nullopt;
}

void Subject::stop() {
  wire::Stop message;
  message.set_reason("a trial is over");
  tell(message);
  while (true) {
    const wire::Frame& frame = next("Finished");
    if (frame.kind == wire::Envelope::kFinished) break;
  }
  if (const int code = exit_code(); code != 0) {
    throw Breach("after Finished its process ended with exit code " + std::to_string(code));
  }
}

int Subject::exit_code() {
  if (!process_->wait(std::chrono::milliseconds(static_cast<int>(1e3 * bench_.patience_s)))) {
    throw Breach("its process still runs after " + seconds_text(bench_.patience_s));
  }
  const auto code = process_->exit_code();
  if (!code) throw Breach("its process " + process_->describe_end());
  return *code;
}

}  // namespace grainstep::conformance
