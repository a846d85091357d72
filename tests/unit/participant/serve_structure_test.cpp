#include <gtest/gtest.h>

#include "one_node.hpp"

namespace grainstep::participant {
namespace {

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
