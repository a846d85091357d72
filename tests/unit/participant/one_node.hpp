/// @file A structure of one node that is served, and an orchestrator that is played by hand.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "base/error.hpp"
#include "scripted_orchestrator.hpp"

namespace grainstep::participant {

/// One node at rest; remembers the order of its calls.
class OneNode final : public StructureBackend {
 public:
  wire::Hello describe() const override {
    wire::Hello hello;
    hello.set_backend("one node");
    hello.add_dimension(2);
    return hello;
  }
  wire::Ready prepare(const wire::Setup& /*setup*/) override {
    wire::Ready ready;
    for (int i = 0; i < 2; ++i) {
      ready.mutable_surface()->add_position(0.0);
      ready.mutable_surface()->add_velocity(0.0);
    }
    return ready;
  }
  void start(const wire::Start& /*start*/) override {
    calls += "start ";
    if (on_start) on_start();
  }
  void advance(const wire::Forces& forces, Due due, wire::Kinematics& next) override {
    calls += "advance" + std::to_string(forces.window()) + (due.report ? "r" : "") + (due.snapshot ? "s" : "") + " ";
    if (forces.window() == fail_at) {
      throw NumericalError("element 3 inverted");
    }
    for (int i = 0; i < 2; ++i) {
      next.add_position(forces.impulse(i));
      next.add_velocity(0.0);
    }
  }
  void report(wire::Report& report) override {
    calls += "report ";
    report.mutable_timing()->set_steps(++reports);
  }
  void snapshot(wire::Snapshot& /*snapshot*/) override { calls += "snapshot "; }
  void complete() override { calls += "complete "; }

  std::string calls;
  std::function<void()> on_start;
  std::uint64_t fail_at = 99;
  std::uint64_t reports = 0;
};

class ServeStructure : public ::testing::Test {
 protected:
  static wire::Setup setup() {
    wire::Setup setup;
    setup.set_protocol(wire::PROTOCOL_VERSION);
    setup.set_scene_hash(4711);
    setup.mutable_structure();
    return setup;
  }
  static wire::Start start() {
    wire::Start start;
    start.set_window(1e-7);
    start.set_windows(3);
    start.set_impactor_steps(1);
    start.set_structure_steps(1);
    start.set_report_every(2);
    start.set_snapshot_every(3);
    return start;
  }
  static wire::Forces forces(std::uint64_t window) {
    wire::Forces forces;
    forces.set_window(window);
    forces.add_impulse(0.5 * static_cast<double>(window));
    forces.add_impulse(0.0);
    return forces;
  }
  static wire::Stop stop() { return {}; }

  testing::ScriptedOrchestrator& orchestrator(const ServeOptions& options = {}) {
    conversation_ = std::make_unique<testing::ScriptedOrchestrator>(
        [this](transport::Channel& channel, const ServeOptions& serve_options) {
          return serve_structure(channel, backend, serve_options);
        },
        options);
    return *conversation_;
  }
  testing::ScriptedOrchestrator& started() {
    auto& talk = orchestrator();
    talk.hear<wire::Hello>();
    talk.tell(setup());
    talk.hear<wire::Ready>();
    talk.tell(start());
    return talk;
  }

  OneNode backend;

 private:
  std::unique_ptr<testing::ScriptedOrchestrator> conversation_;
};

}  // namespace grainstep::participant
