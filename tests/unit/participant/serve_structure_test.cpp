#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <thread>

#include "scripted_orchestrator.hpp"
#include "transport/shared_channel.hpp"

namespace grainstep::participant {
namespace {

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
  void start(const wire::Start& /*start*/) override { calls += "start "; }
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

  testing::ScriptedOrchestrator& orchestrator(ServeOptions options = {}) {
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

TEST_F(ServeStructure, a_whole_run_in_the_documented_order) {
  auto& talk = orchestrator();
  const auto hello = talk.hear<wire::Hello>();
  EXPECT_EQ(hello.protocol(), wire::PROTOCOL_VERSION);
  EXPECT_EQ(hello.role(), wire::STRUCTURE);
  EXPECT_EQ(hello.backend(), "one node");
  EXPECT_NE(hello.process(), 0U);
  talk.tell(setup());
  EXPECT_EQ(talk.hear<wire::Ready>().scene_hash(), 4711U);
  talk.tell(start());
  talk.tell(forces(0));
  EXPECT_EQ(talk.hear<wire::Kinematics>(1).position(0), 0.0);
  talk.hear<wire::Report>(0);
  talk.hear<wire::Snapshot>(0);
  talk.tell(forces(1));
  EXPECT_EQ(talk.hear<wire::Kinematics>(2).position(0), 0.5);
  talk.tell(forces(2));
  talk.hear<wire::Kinematics>(3);
  talk.hear<wire::Report>(2);
  talk.tell(forces(3));
  talk.hear<wire::Report>(3);
  talk.hear<wire::Snapshot>(3);
  talk.tell(stop());
  const auto finished = talk.hear<wire::Finished>();
  EXPECT_EQ(finished.timing().steps(), 3U);
  EXPECT_GE(finished.timing().wait(), 0.0);
  EXPECT_EQ(talk.exit_code(), 0);
  EXPECT_EQ(backend.calls,
            "start advance0rs report snapshot complete advance1 complete advance2r report complete "
            "advance3rs report snapshot complete ");
}

TEST_F(ServeStructure, stop_ends_it_cleanly_at_every_stage) {
  {
    auto& talk = orchestrator();
    talk.hear<wire::Hello>();
    talk.tell(stop());
    talk.hear<wire::Finished>();
    EXPECT_EQ(talk.exit_code(), 0);
  }
  {
    auto& talk = orchestrator();
    talk.hear<wire::Hello>();
    talk.tell(setup());
    talk.hear<wire::Ready>();
    talk.tell(stop());
    talk.hear<wire::Finished>();
    EXPECT_EQ(talk.exit_code(), 0);
  }
  auto& talk = started();
  talk.tell(forces(0));
  talk.hear<wire::Kinematics>(1);
  talk.tell(stop());
  talk.hear<wire::Report>(0);
  talk.hear<wire::Snapshot>(0);
  talk.hear<wire::Finished>();
  EXPECT_EQ(talk.exit_code(), 0);
}

TEST_F(ServeStructure, a_failing_backend_tells_the_orchestrator) {
  backend.fail_at = 1;
  auto& talk = started();
  talk.tell(forces(0));
  talk.hear<wire::Kinematics>(1);
  talk.hear<wire::Report>(0);
  talk.hear<wire::Snapshot>(0);
  talk.tell(forces(1));
  const auto error = talk.hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::NUMERICAL);
  EXPECT_EQ(error.text(), "element 3 inverted");
  EXPECT_EQ(talk.exit_code(), static_cast<int>(ExitCode::numerical));
  EXPECT_EQ(talk.error_text(), "error: element 3 inverted\n");
}

TEST_F(ServeStructure, a_window_out_of_order_is_a_protocol_error) {
  auto& talk = started();
  talk.tell(forces(1));
  const auto error = talk.hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::PROTOCOL);
  EXPECT_EQ(error.text(), "orchestrator: message 3: expected Forces of window 0, got Forces of window 1");
  EXPECT_EQ(talk.exit_code(), static_cast<int>(ExitCode::peer));
}

TEST_F(ServeStructure, a_wrong_number_of_values_is_a_protocol_error) {
  auto& talk = started();
  auto wrong = forces(0);
  wrong.add_impulse(1.0);
  talk.tell(wrong);
  EXPECT_EQ(talk.hear<wire::Error>().text(),
            "orchestrator: Forces.impulse holds 3 values, expected 2 (surface nodes times dimension)");
  EXPECT_EQ(talk.exit_code(), 4);
}

TEST_F(ServeStructure, a_setup_of_another_version_or_role_is_refused) {
  {
    auto& talk = orchestrator();
    talk.hear<wire::Hello>();
    auto other = setup();
    other.set_protocol(9);
    talk.tell(other);
    EXPECT_EQ(talk.hear<wire::Error>().text(), "orchestrator: Setup names protocol version 9, this program speaks " +
                                                   std::to_string(wire::PROTOCOL_VERSION));
    EXPECT_EQ(talk.exit_code(), 4);
  }
  auto& talk = orchestrator();
  talk.hear<wire::Hello>();
  auto other = setup();
  other.mutable_impactor();
  talk.tell(other);
  EXPECT_NE(talk.hear<wire::Error>().text().find("role STRUCTURE"), std::string::npos);
  EXPECT_EQ(talk.exit_code(), 4);
}

TEST_F(ServeStructure, a_lost_orchestrator_ends_it_with_one_line) {
  auto& talk = started();
  talk.vanish();
  EXPECT_EQ(talk.exit_code(), 4);
  EXPECT_EQ(talk.error_text(), "error: orchestrator: closed its channel\n");
}

TEST_F(ServeStructure, a_silent_orchestrator_ends_it_at_the_deadline) {
  auto& talk = orchestrator({.setup_deadline_s = 0.01});
  EXPECT_EQ(talk.exit_code(), 4);
  EXPECT_EQ(talk.error_text(), "error: orchestrator: expected Setup, heard nothing for 0.01 s\n");
}

TEST_F(ServeStructure, while_it_runs_silence_is_borne_for_the_deadline_of_data) {
  auto& talk = orchestrator({.setup_deadline_s = 60.0, .data_deadline_s = 0.01});
  talk.hear<wire::Hello>();
  talk.tell(setup());
  talk.hear<wire::Ready>();
  talk.tell(start());
  EXPECT_EQ(talk.exit_code(), 4);
  EXPECT_EQ(talk.error_text(), "error: orchestrator: expected Forces of window 0, heard nothing for 0.01 s\n");
}

TEST_F(ServeStructure, shared_memory_that_is_not_there_is_said_with_what_to_do) {
  auto& talk = orchestrator();
  talk.hear<wire::Hello>();
  talk.tell(setup());
  talk.hear<wire::Ready>();
  auto elsewhere = start();
  elsewhere.mutable_shared_memory()->set_file("/dev/shm/grainstep-of-another-host/data");
  talk.tell(elsewhere);
  const auto error = talk.hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::BAD_INPUT);
  EXPECT_NE(error.text().find("grainstep-of-another-host"), std::string::npos) << error.text();
  EXPECT_NE(error.text().find("--path hub takes another way"), std::string::npos) << error.text();
  EXPECT_EQ(talk.exit_code(), 2);
}

// The orchestrator has ended the run, the other side goes on and on. Who waits for no data looks at its orchestrator,
// too.
TEST_F(ServeStructure, stop_is_heard_while_data_come_over_shared_memory) {
  using Way = transport::SharedPath::Way;
  const transport::SharedPath path = transport::SharedPath::create(1000);
  backend.fail_at = std::numeric_limits<std::uint64_t>::max();
  auto& talk = orchestrator();
  talk.hear<wire::Hello>();
  talk.tell(setup());
  talk.hear<wire::Ready>();
  auto endless = start();
  endless.set_windows(1'000'000'000'000);
  endless.set_report_every(1e12);
  endless.set_snapshot_every(0.0);
  endless.mutable_shared_memory()->set_file(path.file());
  talk.tell(endless);
  std::atomic<std::uint64_t> windows = 0;
  std::jthread other([&](const std::stop_token& ended) {
    transport::SharedChannel impactor(path, Way::forces, "structure", [] {});
    wire::MessageChannel data(impactor, "structure");
    transport::SharedChannel of_impactor(path, Way::forces, "impactor");
    transport::SharedChannel of_structure(path, Way::kinematics, "structure");
    transport::Bytes heard;
    while (!ended.stop_requested()) {
      data.send(forces(windows));
      while (!ended.stop_requested() && data.receive(transport::in(std::chrono::milliseconds(20))) == nullptr) continue;
      while (of_impactor.receive(heard, transport::Clock::now())) continue;
      while (of_structure.receive(heard, transport::Clock::now())) continue;
      ++windows;
    }
  });
  talk.hear<wire::Report>();
  const auto deadline = grainstep::testing::soon();
  while (windows < 1000 && transport::Clock::now() < deadline) std::this_thread::yield();
  talk.tell(stop());
  talk.hear<wire::Finished>();
  EXPECT_EQ(talk.exit_code(), 0);
}

// Nothing was built that could be started.
TEST_F(ServeStructure, a_start_after_a_preview_is_refused) {
  auto& talk = orchestrator();
  talk.hear<wire::Hello>();
  auto preview = setup();
  preview.set_preview(true);
  talk.tell(preview);
  talk.hear<wire::Ready>();
  talk.tell(start());
  EXPECT_EQ(
      talk.hear<wire::Error>().text(),
      "orchestrator: message 2: expected Stop after the Ready of a preview, for which no model was built, got Start");
  EXPECT_EQ(talk.exit_code(), 4);
}

}  // namespace
}  // namespace grainstep::participant
