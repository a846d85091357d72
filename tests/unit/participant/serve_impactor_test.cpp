#include <gtest/gtest.h>

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
  testing::ScriptedOrchestrator& orchestrator(double depth = 1e-3) {
    conversation_ = std::make_unique<testing::ScriptedOrchestrator>(
        [this](transport::Channel& channel, const ServeOptions& options) {
          return serve_impactor(channel, backend, options);
        });
    EXPECT_EQ(conversation_->hear<wire::Hello>().role(), wire::IMPACTOR);
    wire::Setup setup;
    setup.set_protocol(wire::PROTOCOL_VERSION);
    setup.set_depth(depth);
    auto* surface = setup.mutable_impactor()->mutable_surface();
    surface->add_position(0.0);
    surface->add_position(0.0);
    conversation_->tell(setup);
    return *conversation_;
  }
  testing::ScriptedOrchestrator& started() {
    auto& talk = orchestrator();
    talk.hear<wire::Ready>();
    wire::Start start;
    start.set_windows(2);
    start.set_report_every(1);
    talk.tell(start);
    return talk;
  }
  static wire::Kinematics kinematics(std::uint64_t window, int values = 2) {
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
  talk.tell(kinematics(1, 4));
  EXPECT_NE(talk.hear<wire::Error>().text().find("Kinematics.position holds 4 values, expected 2"), std::string::npos);
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

}  // namespace
}  // namespace grainstep::participant
