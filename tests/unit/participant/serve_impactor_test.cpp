#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scripted_orchestrator.hpp"

namespace grainstep::participant {
namespace {

/// Sends one impulse per window; remembers what it saw.
class Hammer final : public ImpactorBackend {
 public:
  wire::Hello describe() const override { return {}; }
  wire::Ready prepare(const wire::Setup& setup) override {
    if (setup.depth() < 0.0) {
      throw InputError("depth: found -1 m, expected a positive length");
    }
    return {};
  }
  void run(const wire::Start& start, ImpactorLink& link) override {
    for (std::uint64_t window = start.first_window(); window <= start.windows(); ++window) {
      if (window > start.first_window()) {
        const wire::Kinematics* surface = link.surface(window);
        if (surface == nullptr) {
          stopped = true;
          return;
        }
        seen.push_back(surface->position(0));
      }
      wire::Forces forces;
      forces.set_window(window);
      forces.add_impulse(1.0);
      forces.add_impulse(0.0);
      link.send(forces);
      if (link.due(window).report) {
        wire::Report report;
        report.set_window(window);
        report.mutable_timing()->set_steps(window);
        link.send(report);
      }
    }
  }

  std::vector<double> seen;
  bool stopped = false;
};

class ServeImpactor : public ::testing::Test {
 protected:
  testing::ScriptedOrchestrator& orchestrator(
      double depth = 1e-3, const std::function<void(wire::Setup&)>& change = [](wire::Setup&) {}) {
    conversation_ = std::make_unique<testing::ScriptedOrchestrator>(
        [this](transport::Channel& channel, const ServeOptions& options) {
          return serve_impactor(channel, backend, options);
        });
    EXPECT_EQ(conversation_->hear<wire::Hello>().role(), wire::IMPACTOR);
    wire::Setup setup;
    setup.set_protocol(wire::PROTOCOL_VERSION);
    setup.set_depth(depth);
    setup.set_dimension(2);
    wire::Surface& surface = *setup.mutable_impactor()->mutable_surface();
    surface.set_dimension(2);
    for (const double x : {0.0, 0.0, 1.0, 0.0}) {
      surface.add_position(x);
      surface.add_velocity(0.0);
    }
    surface.add_facet(0);
    surface.add_facet(1);
    change(setup);
    conversation_->tell(setup);
    return *conversation_;
  }
  testing::ScriptedOrchestrator& started() {
    auto& talk = orchestrator();
    talk.hear<wire::Ready>();
    talk.tell(start());
    return talk;
  }
  static wire::Start start() {
    wire::Start start;
    start.set_window(1e-7);
    start.set_windows(2);
    start.set_impactor_steps(1);
    start.set_structure_steps(1);
    start.set_report_every(1);
    return start;
  }
  static wire::Kinematics kinematics(std::uint64_t window, int values = 4) {
    wire::Kinematics message;
    message.set_window(window);
    for (int i = 0; i < values; ++i) {
      message.add_position(-0.1 * static_cast<double>(window));
      message.add_velocity(0.0);
    }
    return message;
  }

  Hammer backend;

 private:
  std::unique_ptr<testing::ScriptedOrchestrator> conversation_;
};

TEST_F(ServeImpactor, a_whole_run) {
  auto& talk = started();
  talk.hear<wire::Forces>(0);
  const auto first = talk.hear<wire::Report>(0);
  EXPECT_EQ(first.timing().wait(), 0.0);  // nothing was waited for yet
  EXPECT_GT(first.timing().compute(), 0.0);
  talk.tell(kinematics(1));
  talk.hear<wire::Forces>(1);
  EXPECT_GT(talk.hear<wire::Report>(1).timing().wait(), 0.0);
  talk.tell(kinematics(2));
  talk.hear<wire::Forces>(2);
  talk.hear<wire::Report>(2);
  talk.tell(wire::Stop());
  EXPECT_EQ(talk.hear<wire::Finished>().timing().steps(), 2U);
  EXPECT_EQ(talk.exit_code(), 0);
  EXPECT_EQ(backend.seen, (std::vector<double>{-0.1, -0.2}));
}

TEST_F(ServeImpactor, stop_in_place_of_a_surface_ends_it_cleanly) {
  auto& talk = started();
  talk.hear<wire::Forces>(0);
  talk.hear<wire::Report>(0);
  talk.tell(wire::Stop());
  talk.hear<wire::Finished>();
  EXPECT_EQ(talk.exit_code(), 0);
  EXPECT_TRUE(backend.stopped);
}

TEST_F(ServeImpactor, a_scene_it_cannot_compute_is_bad_input) {
  auto& talk = orchestrator(-1.0);
  const auto error = talk.hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::BAD_INPUT);
  EXPECT_EQ(error.text(), "depth: found -1 m, expected a positive length");
  EXPECT_EQ(talk.exit_code(), 2);
}

TEST_F(ServeImpactor, a_surface_of_another_size_is_refused) {
  auto& talk = started();
  talk.hear<wire::Forces>(0);
  talk.hear<wire::Report>(0);
  talk.tell(kinematics(1, 6));
  EXPECT_NE(talk.hear<wire::Error>().text().find("Kinematics.position holds 6 values, expected 4"), std::string::npos);
  EXPECT_EQ(talk.exit_code(), 4);
}

TEST_F(ServeImpactor, an_orchestrator_lost_in_mid_run_ends_it) {
  auto& talk = started();
  talk.hear<wire::Forces>(0);
  talk.hear<wire::Report>(0);
  talk.vanish();
  EXPECT_EQ(talk.exit_code(), 4);
  EXPECT_EQ(talk.error_text(), "error: orchestrator: closed its channel\n");
}

TEST_F(ServeImpactor, a_surface_that_is_none_is_refused_before_a_model_is_built) {
  const struct {
    const char* told;
    std::function<void(wire::Surface&)> change;
  } cases[] = {{": facet 0 names node 2147483649", [](wire::Surface& s) { s.set_facet(1, 0x80000001U); }},
               {" has dimension 3, the run has 2", [](wire::Surface& s) { s.set_dimension(3); }},
               {" has no nodes", [](wire::Surface& s) { s.Clear(), s.set_dimension(2); }},
               {".position holds 5 numbers, expected 4", [](wire::Surface& s) { s.add_position(1.0); }},
               {".velocity holds 0 numbers, expected 4", [](wire::Surface& s) { s.clear_velocity(); }},
               {".position[2] = nan; it must be a number", [](wire::Surface& s) { s.set_position(2, std::nan("")); }},
               {".velocity[0] = inf; it must be a number", [](wire::Surface& s) { s.set_velocity(0, HUGE_VAL); }},
               {".facet holds 0 node numbers", [](wire::Surface& s) { s.clear_facet(); }},
               {": facet 0 has no length", [](wire::Surface& s) { s.set_facet(1, 0); }},
               {": facet 0 has no length that is a number",
                [](wire::Surface& s) { s.set_position(0, 1e308), s.set_position(2, -1e308); }}};
  for (const auto& one : cases) {
    auto& talk =
        orchestrator(1e-3, [&](wire::Setup& setup) { one.change(*setup.mutable_impactor()->mutable_surface()); });
    EXPECT_EQ(talk.hear<wire::Error>().kind(), wire::Error::PROTOCOL);
    EXPECT_THAT(talk.error_text(), ::testing::HasSubstr(std::string("Setup.impactor.surface") + one.told));
    EXPECT_EQ(talk.exit_code(), 4);
  }
}

TEST_F(ServeImpactor, a_preview_may_be_without_a_surface) {
  auto& talk = orchestrator(1e-3, [](wire::Setup& setup) {
    setup.set_preview(true);
    setup.mutable_impactor()->clear_surface();
  });
  talk.hear<wire::Ready>();
  talk.tell(wire::Stop());
  EXPECT_EQ(talk.exit_code(), 0);
}

TEST_F(ServeImpactor, a_start_that_cannot_be_counted_is_refused) {
  const struct {
    const char* told;
    std::function<void(wire::Start&)> change;
  } cases[] = {{"Start.window is nan s; it must be above 0", [](wire::Start& s) { s.set_window(std::nan("")); }},
               {"Start.window is 0 s; it must be above 0", [](wire::Start& s) { s.set_window(0.0); }},
               {"Start.window is inf s; it must be above 0", [](wire::Start& s) { s.set_window(HUGE_VAL); }},
               {"Start.impactor_steps is 0; a window has 1 to", [](wire::Start& s) { s.set_impactor_steps(0); }},
               {"Start.structure_steps is 4294967295; a", [](wire::Start& s) { s.set_structure_steps(0xffffffffU); }},
               {"Start.report_every is -1 windows", [](wire::Start& s) { s.set_report_every(-1.0); }},
               {"Start.snapshot_every is nan windows", [](wire::Start& s) { s.set_snapshot_every(std::nan("")); }},
               {"Start begins at window 3 of a run of 2", [](wire::Start& s) { s.set_first_window(3); }}};
  for (const auto& one : cases) {
    auto& talk = orchestrator();
    talk.hear<wire::Ready>();
    wire::Start wrong = start();
    one.change(wrong);
    talk.tell(wrong);
    EXPECT_EQ(talk.hear<wire::Error>().kind(), wire::Error::PROTOCOL);
    EXPECT_THAT(talk.error_text(), ::testing::HasSubstr(one.told));
    EXPECT_EQ(talk.exit_code(), 4);
  }
}

TEST_F(ServeImpactor, kinematics_that_are_no_numbers_end_it_as_numerical) {
  auto& talk = started();
  talk.hear<wire::Forces>(0);
  talk.hear<wire::Report>(0);
  wire::Kinematics wrong = kinematics(1);
  wrong.set_position(1, std::nan(""));
  talk.tell(wrong);
  const auto error = talk.hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::NUMERICAL);
  EXPECT_THAT(error.text(), ::testing::HasSubstr("Kinematics.position of window 1: value 1 is nan"));
  EXPECT_EQ(talk.exit_code(), 3);
}

}  // namespace
}  // namespace grainstep::participant
