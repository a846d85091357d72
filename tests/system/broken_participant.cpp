/// @file broken-participant --role ROLE --breach NAME: our own structure or impactor behind a channel that breaks one
/// clause of the protocol. `grainstep conformance` must find each of them (test_conformance.py).
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "base/error.hpp"
#include "dem-service/lammps/impactor.hpp"
#include "fe-service/impactor.hpp"
#include "fe-service/structure.hpp"
#include "participant/program.hpp"
#include "participant/serve.hpp"
#include "wire/codec.hpp"

namespace {

using namespace grainstep;

/// What is done to a message on its way out, or in.
struct Breach {
  std::function<void(wire::Envelope&)> out = [](wire::Envelope&) {};
  std::function<bool(wire::Envelope&)> in = [](wire::Envelope&) { return true; };  // false: it is swallowed
  bool survives_loss = false;
  int exit_code = 0;
};

void scale(google::protobuf::RepeatedField<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

std::map<std::string, Breach> breaches() {
  std::map<std::string, Breach> all;
  const auto out = [&all](const char* name, std::function<void(wire::Envelope&)> act) {
    all[name].out = std::move(act);
  };
  out("version", [](auto& e) {
    if (e.has_hello()) e.mutable_hello()->set_protocol(1);
  });
  out("incapable", [](auto& e) {
    if (e.has_hello()) e.mutable_hello()->clear_capabilities();
  });
  out("another_scene", [](auto& e) {
    if (e.has_ready()) e.mutable_ready()->set_scene_hash(1);
  });
  out("nan_mass", [](auto& e) {
    if (e.has_ready()) e.mutable_ready()->set_mass(0.0 / 0.0);
  });
  out("drifts", [](auto& e) {
    if (!e.has_kinematics()) return;
    for (double& x : *e.mutable_kinematics()->mutable_position())
      x += 1e-6 * static_cast<double>(e.kinematics().window());
  });
  out("faster_than_it_moves", [](auto& e) {
    if (e.has_kinematics()) scale(*e.mutable_kinematics()->mutable_velocity(), 1.01);
  });
  out("receives_more", [](auto& e) {
    if (e.has_report()) scale(*e.mutable_report()->mutable_momentum()->mutable_interface_impulse(), 1.001);
  });
  out("loses_momentum", [](auto& e) {
    if (e.has_report()) scale(*e.mutable_report()->mutable_momentum()->mutable_linear(), 0.99);
  });
  out("makes_energy", [](auto& e) {
    if (!e.has_report()) return;
    auto& energy = *e.mutable_report()->mutable_energy();
    energy.set_plastic(energy.plastic() + (e.report().window() > 0 ? energy.kinetic() + energy.elastic() : 0.0));
  });
  out("books_other_work", [](auto& e) {
    if (!e.has_report()) return;
    auto& energy = *e.mutable_report()->mutable_energy();
    energy.set_interface_work(1.5 * energy.interface_work());
    for (auto& one : *e.mutable_report()->mutable_observable()) {
      if (one.name() == "work_on_surface") one.set_value(1.5 * one.value());
    }
  });
  out("names_a_path", [](auto& e) {
    if (e.has_report()) e.mutable_report()->add_observable()->set_name("a/b");
  });
  out("snapshot_too_small", [](auto& e) {
    if (e.has_snapshot() && e.snapshot().point_field_size() > 0) {
      e.mutable_snapshot()->mutable_point_field(0)->mutable_value()->RemoveLast();
    }
  });

  const auto in = [&all](const char* name, std::function<bool(wire::Envelope&)> act) { all[name].in = std::move(act); };
  in("deaf_to_stop", [](auto& e) { return !e.has_stop(); });
  in("takes_any_version", [](auto& e) {
    if (e.has_setup()) e.mutable_setup()->set_protocol(wire::PROTOCOL_VERSION);
    return true;
  });
  in("takes_any_window", [next = std::uint64_t{0}](auto& e) mutable {
    if (e.has_forces()) e.mutable_forces()->set_window(next++);
    if (e.has_kinematics()) e.mutable_kinematics()->set_window(++next);
    return true;
  });
  in("takes_any_length", [](auto& e) {
    if (e.has_forces() && e.forces().impulse_size() % 2 == 1) e.mutable_forces()->mutable_impulse()->RemoveLast();
    if (e.has_kinematics() && e.kinematics().position_size() % 2 == 1) {
      e.mutable_kinematics()->mutable_position()->RemoveLast();
    }
    return true;
  });
  in("another_model_in_a_preview", [](auto& e) {
    if (e.has_setup() && e.setup().preview()) {
      e.mutable_setup()->mutable_structure()->mutable_structure()->mutable_mesh()->set_refinement(3.0);
    }
    return true;
  });
  in("blind_to_motion", [rest = wire::Surface()](auto& e) mutable {
    if (e.has_setup()) rest = e.setup().impactor().surface();
    if (!e.has_kinematics()) return true;
    *e.mutable_kinematics()->mutable_position() = rest.position();
    *e.mutable_kinematics()->mutable_velocity() = rest.velocity();
    return true;
  });
  all["outlives_the_orchestrator"].survives_loss = true;
  all["exit_code"].exit_code = 1;
  return all;
}

class BreachingChannel final : public transport::Channel {
 public:
  BreachingChannel(transport::Channel& real, Breach& breach) : real_(real), breach_(breach) {}

  void send(std::span<const std::byte> message) override {
    wire::Envelope envelope = payload_of(message);
    breach_.out(envelope);
    const std::string payload = envelope.SerializeAsString();
    real_.send(outgoing_.forward(std::as_bytes(std::span(payload))));
  }

  bool receive(transport::Bytes& message, transport::Deadline deadline) override {
    while (true) {
      try {
        if (!real_.receive(message, deadline)) return false;
      } catch (const PeerError&) {
        while (breach_.survives_loss) std::this_thread::sleep_for(std::chrono::hours(1));
        throw;
      }
      if (message.size() < wire::header_size) return true;
      wire::Envelope envelope = payload_of(message);
      if (envelope.body_case() == wire::Envelope::BODY_NOT_SET) return true;  // nonsense stays nonsense
      if (!breach_.in(envelope)) continue;
      const std::string payload = envelope.SerializeAsString();
      const auto frame = incoming_.forward(std::as_bytes(std::span(payload)));
      message.assign(frame.begin(), frame.end());
      return true;
    }
  }
  [[nodiscard]] int wakeup() const override { return real_.wakeup(); }

 private:
  static wire::Envelope payload_of(std::span<const std::byte> frame) {
    wire::Envelope out;
    const auto payload = frame.subspan(wire::header_size);
    if (!out.ParseFromArray(payload.data(), static_cast<int>(payload.size()))) out.Clear();
    return out;
  }

  transport::Channel& real_;
  Breach& breach_;
  wire::Encoder outgoing_, incoming_;
};

}  // namespace

int main(int argc, char** argv) {
  participant::Program program("broken-participant", "1", "One of Grainstep's own participants, with a fault");
  std::map<std::string, Breach> all = breaches();
  std::vector<std::string> names;
  for (const auto& [name, breach] : all) names.push_back(name);
  std::string role = "structure";
  std::string name;
  program.option("role", "which side", role, {"structure", "impactor"});
  program.option("breach", "which fault", name, names);
  if (const auto code = program.parse(argc, argv)) return *code;
  Breach& breach = all.at(name);
  const int code = program.run([&](transport::Channel& real) {
    BreachingChannel channel(real, breach);
    if (role == "impactor") {
      const auto impactor = dem::make_impactor({});
      return participant::serve_impactor(channel, *impactor);
    }
    fe::Structure structure;
    return participant::serve_structure(channel, structure);
  });
  return code == 0 ? breach.exit_code : code;
}
