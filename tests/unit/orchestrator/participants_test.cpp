// Where participants are expected: the part of their wiring that can be seen without starting them.
#include "orchestrator/process/participants.hpp"

#include <gmock/gmock.h>

#include <optional>
#include <random>

#include "base/error.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::string& endpoint) {
  try {
    static_cast<void>(next_port(endpoint));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(NextPort, IsOneAbove) {
  EXPECT_EQ(next_port("tcp://127.0.0.1:5555"), "tcp://127.0.0.1:5556");
  EXPECT_EQ(next_port("tcp://[::1]:5999"), "tcp://[::1]:6000");
  EXPECT_EQ(next_port("tcp://*:65534"), "tcp://*:65535");
}

TEST(NextPort, AnyFreeOneStaysAnyFreeOne) {
  EXPECT_EQ(next_port("tcp://127.0.0.1:*"), "tcp://127.0.0.1:*");
  EXPECT_EQ(next_port("tcp://127.0.0.1:0"), "tcp://127.0.0.1:0");
}

TEST(NextPort, WhatIsNoPortIsRefused) {
  for (const char* endpoint : {"tcp://host:65535", "tcp://host:99999999999", "tcp://host:port", "tcp://host:12x"}) {
    EXPECT_THAT(refusal(endpoint), HasSubstr("expected tcp://HOST:PORT with a PORT below 65535")) << endpoint;
  }
}

std::string endpoint_of(transport::Channel& channel) {
  return dynamic_cast<transport::ZmqChannel&>(channel).endpoint();
}

/// Both participants external at a pair of ports; ports that somebody else has are passed over.
std::optional<std::pair<std::string, std::string>> endpoints_at(unsigned port) {
  RunOptions options;
  options.external = {"impactor", "structure"};
  options.listen = "tcp://127.0.0.1:" + std::to_string(port);
  try {
    Participants participants(scene::Scene{}, options);
    return std::pair{endpoint_of(participants.impactor()), endpoint_of(participants.structure())};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

TEST(Participants, TheImpactorHasThePortAndTheStructureTheNext) {
  std::mt19937 random(std::random_device{}());
  for (int attempt = 0; attempt < 100; ++attempt) {
    const auto port = static_cast<unsigned>(20000 + random() % 30000);
    if (const auto found = endpoints_at(port)) {
      EXPECT_EQ(found->first, "tcp://127.0.0.1:" + std::to_string(port));
      EXPECT_EQ(found->second, "tcp://127.0.0.1:" + std::to_string(port + 1));
      return;
    }
  }
  FAIL() << "no two neighbouring ports are free on this machine";
}

TEST(Participants, ThoseOfThisHostHavePrivateSockets) {
  RunOptions options;
  options.listen = "tcp://127.0.0.1:*";
  options.external = {"structure"};
  scene::Scene scene;
  scene.mutable_impactor()->set_type(scene::Impactor::TYPE_SLUG);
  Participants participants(scene, options);
  EXPECT_THAT(endpoint_of(participants.impactor()), HasSubstr("ipc://"));
  EXPECT_THAT(endpoint_of(participants.structure()), HasSubstr("tcp://127.0.0.1:"));
}

std::string refusal_of(const scene::Scene& scene, const RunOptions& options) {
  try {
    check_programs(scene, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Programs, AnotherThanOursRunsOnlyOnTheUsersOwnWord) {
  scene::Scene scene;
  scene.mutable_structure()->set_type(scene::Structure::TYPE_BEAM);
  EXPECT_EQ(refusal_of(scene, {}), "");
  scene.mutable_structure()->set_program("grainstep-fe");
  EXPECT_EQ(refusal_of(scene, {}), "");
  scene.mutable_structure()->set_program("./mine.py");
  EXPECT_THAT(refusal_of(scene, {}), HasSubstr("structure.program: the scene would start './mine.py'"));
  EXPECT_THAT(refusal_of(scene, {}), HasSubstr("--set structure.program=./mine.py, or --allow-program"));
  RunOptions options;
  options.allow_program = true;
  EXPECT_EQ(refusal_of(scene, options), "");
  options.allow_program = false;
  options.scene.set = {"structure.programs=x", "impactor.program=./mine.py"};
  EXPECT_NE(refusal_of(scene, options), "");
  options.scene.set = {"structure.program=./mine.py"};
  EXPECT_EQ(refusal_of(scene, options), "");
  options.scene.set.clear();
  options.external = {"structure"};  // nothing is started here
  EXPECT_EQ(refusal_of(scene, options), "");
}

}  // namespace
}  // namespace grainstep::orchestrator
