/// The participant in another language keeps to the protocol, and its physics are those of a mass on a spring.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "patience.hpp"
#include "process/child_process.hpp"
#include "transport/zmq_channel.hpp"
#include "wire/message_channel.hpp"

namespace grainstep {
namespace {

constexpr double mass = 0.2;       // kg: 0.5 m x 50 mm x 1 mm of steel
constexpr double step = 1e-5;      // s
constexpr double stiffness = 2e5;  // N/m
constexpr double blow = 0.6;       // N s, in window 0
constexpr std::uint64_t windows = 400;

class ExampleParticipant : public ::testing::Test {
 protected:
  template <class Message>
  Message hear() {
    const wire::Frame* frame = messages_.receive(testing::soon());
    Message message;
    if (frame == nullptr) {
      throw std::runtime_error("silence; its log: " + child_.log_tail(20));
    }
    messages_.take(*frame, message);
    return message;
  }

  void introduce() {
    const auto hello = hear<wire::Hello>();
    EXPECT_EQ(hello.role(), wire::STRUCTURE);
    EXPECT_EQ(hello.protocol(), wire::PROTOCOL_VERSION);
    wire::Setup setup;
    setup.set_protocol(wire::PROTOCOL_VERSION);
    setup.set_scene_hash(99);
    setup.set_dimension(2);
    setup.set_depth(1e-3);
    setup.set_mirror(true);
    auto* beam = setup.mutable_structure()->mutable_structure();
    beam->set_half_span(0.5);
    beam->add_layers()->set_thickness(0.05);
    beam->mutable_layers(0)->set_density(8000.0);
    messages_.send(setup);
    const auto ready = hear<wire::Ready>();
    EXPECT_EQ(ready.scene_hash(), 99U);
    EXPECT_DOUBLE_EQ(ready.mass(), mass);
    EXPECT_GT(ready.stable_step(), step);
    EXPECT_EQ(ready.surface().facet_size(), 2);
    wire::Start start;
    start.set_window(step);
    start.set_windows(windows);
    start.set_impactor_steps(1);
    start.set_structure_steps(1);
    start.set_report_every(windows);
    messages_.send(start);
  }

  wire::Forces forces(std::uint64_t window, double push) const {
    wire::Forces result;
    result.set_window(window);
    for (const double value : {0.0, push, 0.0, 0.0}) {
      result.add_impulse(value);
    }
    return result;
  }

  TemporaryDirectory directory_;
  std::unique_ptr<transport::ZmqChannel> channel_ =
      transport::ZmqChannel::bind("ipc://" + (directory_.path() / "structure").string());
  wire::MessageChannel messages_{*channel_, "example"};
  process::ChildProcess child_{"example",
                               {PYTHON, {EXAMPLE, "--connect", channel_->endpoint()}, {{"PYTHONPATH", PACKAGE}}},
                               directory_.path() / "log"};
};

TEST_F(ExampleParticipant, swings_as_a_mass_on_a_spring) {
  introduce();
  messages_.send(forces(0, -blow));
  wire::Kinematics surface;
  wire::Report first;
  for (std::uint64_t window = 1; window <= windows; ++window) {
    surface = hear<wire::Kinematics>();
    ASSERT_EQ(surface.window(), window);
    if (window == 1) {
      first = hear<wire::Report>();
    }
    messages_.send(forces(window, 0.0));
  }
  const auto last = hear<wire::Report>();
  EXPECT_EQ(first.momentum().linear(1), 0.0);
  EXPECT_EQ(first.momentum().interface_impulse(1), 0.0);
  EXPECT_EQ(last.window(), windows);

  // Closed form: x = -(J/sqrt(k m)) sin(omega t). Central differences: the error is of second order, (omega dt)^2 =
  // 1e-4.
  const double omega = std::sqrt(stiffness / mass);
  const double amplitude = blow / std::sqrt(stiffness * mass);
  EXPECT_NEAR(surface.position(1), -amplitude * std::sin(omega * step * windows), 1e-4 * amplitude);
  // Exact: momentum is what was received.
  const auto& momentum = last.momentum();
  EXPECT_NEAR(momentum.linear(1), momentum.interface_impulse(1) + momentum.support_impulse(1), 1e-12 * blow);
  EXPECT_DOUBLE_EQ(momentum.interface_impulse(1), -blow);
  // Second order again: energy is the work done on it.
  EXPECT_NEAR(last.energy().kinetic() + last.energy().elastic(), last.energy().interface_work(),
              1e-4 * last.energy().interface_work());

  messages_.send(wire::Stop());
  EXPECT_EQ(hear<wire::Finished>().timing().steps(), windows + 1);
  ASSERT_TRUE(child_.wait(testing::patience));
  EXPECT_EQ(child_.exit_code(), 0) << child_.log_tail(20);
}

TEST_F(ExampleParticipant, refuses_forces_out_of_order) {
  introduce();
  messages_.send(forces(5, -blow));
  const auto error = hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::PROTOCOL);
  ASSERT_TRUE(child_.wait(testing::patience));
  EXPECT_EQ(child_.exit_code(), 4);
}

TEST_F(ExampleParticipant, ends_with_its_orchestrator) {
  introduce();
  channel_.reset();
  ASSERT_TRUE(child_.wait(testing::patience));
  EXPECT_EQ(child_.exit_code(), 4);
  EXPECT_THAT(child_.log_tail(1), ::testing::StartsWith("error: orchestrator: connection lost"));
}

}  // namespace
}  // namespace grainstep
