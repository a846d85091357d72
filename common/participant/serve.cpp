#include "participant/serve.hpp"

#include <iostream>
#include <new>
#include <stdexcept>

#include "base/archive.hpp"
#include "base/error.hpp"
#include "participant/conversation.hpp"
#include "participant/give_way.hpp"
#include "participant/schedule.hpp"
#include "wire/finite.hpp"

namespace grainstep::participant {
namespace {

/// A wrong number of values would be an index out of range in the backend.
void check_length(const Conversation& talk, const char* what, int found, int expected) {
  if (found != expected) {
    talk.refuse(std::string(what) + " holds " + std::to_string(found) + " values, expected " +
                std::to_string(expected) + " (surface nodes times dimension)");
  }
}

/// The orchestrator forwards before it looks. What is no number would become a place, and then an index.
void check_finite(const char* what, std::uint64_t window, const google::protobuf::RepeatedField<double>& values) {
  wire::require_finite(what, window, values, "The other side's computation has become unstable: try smaller steps.");
}

/// What a structure goes on from: what it is, and what it has told the impactor last.
struct StructureState {
  wire::Kinematics& next;
  std::string backend;

  template <class Archive>
  void serialize(Archive& archive) {
    archive("kinematics", next);
    archive("backend", backend);
  }
};

std::string saved(StructureBackend& backend, wire::Kinematics& next) {
  StructureState state{next, backend.save()};
  return base::saved(state);
}

void restore(StructureBackend& backend, wire::Kinematics& next, const std::string& bytes) {
  StructureState state{next, {}};
  base::restore(state, bytes);
  backend.restore(state.backend);
}

void converse(Conversation& talk, StructureBackend& backend) {
  wire::Setup setup;
  wire::Start start;
  if (!talk.introduce(backend.describe(), wire::STRUCTURE, setup)) {
    return talk.finish();
  }
  const wire::Ready ready = backend.prepare(setup);
  const int values = ready.surface().position_size();
  talk.ready(ready, setup);
  if (!talk.wait_for_start(start)) {
    return talk.finish();
  }
  backend.start(start);

  wire::Forces forces;
  wire::Kinematics next;
  if (talk.restored()) {
    restore(backend, next, *talk.restored());
    talk.send(next);
  }
  wire::Report report;
  wire::Snapshot snapshot;
  for (std::uint64_t window = start.first_window(); window <= start.windows(); ++window) {
    if (!talk.wait_for(forces, window)) {
      break;
    }
    check_length(talk, "Forces.impulse", forces.impulse_size(), values);
    talk.knock();
    const Due due = due_at(start, window);
    next.Clear();
    next.set_window(window + 1);
    backend.advance(forces, due, next);
    if (window < start.windows()) {
      talk.send(next);
    }
    if (due.report) {
      report.Clear();
      report.set_window(window);
      backend.report(report);
      talk.send_report(report);
    }
    if (due.snapshot) {
      snapshot.Clear();
      snapshot.set_window(window);
      backend.snapshot(snapshot);
      talk.send(snapshot);
    }
    backend.complete();
    if (talk.wants_state(window)) talk.send_state(window, saved(backend, next));
  }
  talk.finish();
}

class Link final : public ImpactorLink {
 public:
  Link(Conversation& talk, const wire::Start& start, int values) : talk_(talk), start_(start), values_(values) {}

  const wire::Kinematics* surface(std::uint64_t window) override {
    if (!talk_.wait_for(kinematics_, window)) {
      return nullptr;
    }
    check_length(talk_, "Kinematics.position", kinematics_.position_size(), values_);
    check_length(talk_, "Kinematics.velocity", kinematics_.velocity_size(), values_);
    check_finite("Kinematics.position", window, kinematics_.position());
    check_finite("Kinematics.velocity", window, kinematics_.velocity());
    return &kinematics_;
  }

  Due due(std::uint64_t window) const override { return due_at(start_, window); }
  void soon() override { talk_.knock(); }
  void send(const wire::Forces& forces) override { talk_.send(forces); }
  void send(wire::Report& report) override { talk_.send_report(report); }
  void send(const wire::Snapshot& snapshot) override { talk_.send(snapshot); }
  bool wants_state(std::uint64_t window) override {
    window_ = window;
    return talk_.wants_state(window);
  }
  void send_state(std::string_view state) override { talk_.send_state(window_, state); }
  std::optional<std::string_view> state() const override { return talk_.restored(); }

 private:
  Conversation& talk_;
  const wire::Start& start_;
  int values_;
  std::uint64_t window_ = 0;  ///< that was asked for
  wire::Kinematics kinematics_;
};

void converse(Conversation& talk, ImpactorBackend& backend) {
  wire::Setup setup;
  wire::Start start;
  if (!talk.introduce(backend.describe(), wire::IMPACTOR, setup)) {
    return talk.finish();
  }
  talk.ready(backend.prepare(setup), setup);
  if (!talk.wait_for_start(start)) {
    return talk.finish();
  }
  Link link(talk, start, setup.impactor().surface().position_size());
  backend.run(start, link);
  talk.finish();
}

struct BadEnd {
  wire::Error::Kind kind;
  ExitCode code;
  std::string text;
};

/// Tells the orchestrator, if it is still there, and the person at the terminal.
int end_badly(Conversation& talk, const ServeOptions& options, const BadEnd& end) {
  std::ostream& errors = options.errors == nullptr ? std::cerr : *options.errors;
  errors << "error: " << end.text << '\n' << std::flush;
  try {
    wire::Error error;
    error.set_kind(end.kind);
    error.set_text(end.text);
    talk.send_error(error);
  } catch (const PeerError&) {  // it is lost: that was said above, or is why we are here
  }
  return static_cast<int>(end.code);
}

template <class Backend>
int serve(transport::Channel& channel, Backend& backend, const ServeOptions& options) {
  Conversation talk(channel, options);
  give_way_to_messages();
  const auto bad = [&](wire::Error::Kind kind, ExitCode code, const std::exception& error) {
    return end_badly(talk, options, {kind, code, error.what()});
  };
  try {
    converse(talk, backend);
    return static_cast<int>(ExitCode::done);
  } catch (const InputError& error) {
    return bad(wire::Error::BAD_INPUT, ExitCode::bad_input, error);
  } catch (const NumericalError& error) {
    return bad(wire::Error::NUMERICAL, ExitCode::numerical, error);
  } catch (const PeerError& error) {
    return bad(wire::Error::PROTOCOL, ExitCode::peer, error);
  } catch (const std::bad_alloc&) {
    return end_badly(talk, options,
                     {wire::Error::INTERNAL, ExitCode::peer,
                      "the system gives no more memory; grainstep check estimates what a scene takes"});
  } catch (const std::range_error& error) {  // of common/base/archive.hpp
    return end_badly(talk, options,
                     {wire::Error::BAD_INPUT, ExitCode::bad_input,
                      std::string("the state to go on from is not one of this model: ") + error.what()});
  } catch (const std::exception& error) {
    return bad(wire::Error::INTERNAL, ExitCode::peer, error);
  }
}

}  // namespace

std::string StructureBackend::save() {
  throw std::logic_error("a structure that says it can save its state must override save()");
}
void StructureBackend::restore(std::string_view /*state*/) {
  throw std::logic_error("a structure that says it can save its state must override restore()");
}

int serve_structure(transport::Channel& channel, StructureBackend& backend, const ServeOptions& options) {
  return serve(channel, backend, options);
}

int serve_impactor(transport::Channel& channel, ImpactorBackend& backend, const ServeOptions& options) {
  return serve(channel, backend, options);
}

}  // namespace grainstep::participant
