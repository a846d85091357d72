// The connection between two participants: who gets in, and what is heard beside it.
#include "participant/direct_path.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <future>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "one_node.hpp"
#include "patience.hpp"
#include "transport/curve.hpp"
#include "transport/local_address.hpp"

namespace grainstep::participant {
namespace {

using grainstep::testing::soon;

class DirectPath : public ::testing::Test {
 protected:
  /// A directory with a new pair of keys.
  std::filesystem::path keys(const char* name) const {
    std::filesystem::path directory = directory_.path() / name;
    transport::make_keys(directory);
    return directory;
  }
  [[nodiscard]] std::string local() const { return "ipc://" + (directory_.path() / "data").string(); }

  static std::future<std::unique_ptr<DataPath>> opened(
      DirectDoor& door, const WhileWaiting& look = [] {}) {
    return std::async(std::launch::async, [&door, look] { return std::move(door).open(look); });
  }

  TemporaryDirectory directory_;
};

TEST_F(DirectPath, CarriesMessagesBetweenThoseWithTheSameKeys) {
  const auto directory = keys("ours");
  DirectDoor door({.listen = "tcp://127.0.0.1:0", .curve_dir = directory});
  auto structure = opened(door);
  const auto impactor = connect_directly(door.endpoint(), {.listen = "", .curve_dir = directory}, [] {});
  wire::Forces forces;
  forces.set_window(3);
  impactor->messages().send(forces);
  const auto there = structure.get();
  const wire::Frame* frame = there->messages().receive(soon());
  ASSERT_NE(frame, nullptr);
  there->messages().take(*frame, forces, 3);
  EXPECT_TRUE(there->wants_copies());
}

TEST_F(DirectPath, TurnsAwayThoseWithoutTheKeys) {
  DirectDoor door({.listen = "tcp://127.0.0.1:0", .curve_dir = keys("ours"), .connect_deadline_s = 2.0});
  const std::string endpoint = door.endpoint();
  auto structure = opened(door);
  const DirectOptions plain{.listen = "", .connect_deadline_s = 0.5};
  EXPECT_THROW(static_cast<void>(connect_directly(endpoint, plain, [] {})), PeerError);
  const DirectOptions stranger{.listen = "", .curve_dir = keys("theirs"), .connect_deadline_s = 0.5};
  EXPECT_THROW(static_cast<void>(connect_directly(endpoint, stranger, [] {})), PeerError);
  EXPECT_THROW(static_cast<void>(structure.get()), PeerError) << "nobody came";
}

TEST_F(DirectPath, OverANetworkIsNotTakenInTheClear) { EXPECT_THROW(DirectDoor({.listen = "tcp://*:0"}), InputError); }

TEST_F(DirectPath, OnAllInterfacesNamesTheHost) {
  const DirectDoor door({.listen = "tcp://*:0", .allow_plain_tcp = true});
  std::array<char, 256> host{};
  ASSERT_EQ(::gethostname(host.data(), host.size() - 1), 0);
  EXPECT_TRUE(door.endpoint().starts_with(std::string("tcp://") + host.data() + ":")) << door.endpoint();
}

// A name that the impactor's host does not know would be of no use.
TEST_F(DirectPath, OnAllInterfacesNamesTheOneThatLeadsToTheOrchestrator) {
  const std::string elsewhere = "tcp://192.0.2.1:5555";  // an address for documentation: nothing is sent
  const auto own = transport::local_address_towards(elsewhere);
  if (!own) GTEST_SKIP() << "this host has no route to anywhere";
  DirectDoor door({.listen = "tcp://*:0", .allow_plain_tcp = true, .orchestrator = elsewhere});
  EXPECT_TRUE(door.endpoint().starts_with("tcp://" + *own + ":")) << door.endpoint();
  auto structure = opened(door);
  static_cast<void>(connect_directly(door.endpoint(), {.listen = "", .allow_plain_tcp = true}, [] {}));
  EXPECT_NE(structure.get(), nullptr);
}

TEST(LocalAddress, IsKnownOnlyTowardsOthers) {
  for (const char* here :
       {"tcp://127.0.0.1:5555", "tcp://localhost:5555", "ipc:///run/x", "tcp://", "tcp://:", "tcp://a b:1"}) {
    EXPECT_EQ(transport::local_address_towards(here), std::nullopt) << here;
  }
}

struct Stopped {};

// Whoever waits looks elsewhere: for data, for the other side to come, and after it was lost.
TEST_F(DirectPath, LooksElsewhereWhileItWaits) {
  DirectDoor door({.listen = local()});
  std::atomic<bool> stop = false;
  const auto look = [&stop] {
    if (stop) throw Stopped();
  };
  auto structure = opened(door, look);
  auto impactor = connect_directly(door.endpoint(), {}, [] {});
  const auto there = structure.get();
  stop = true;
  EXPECT_THROW(static_cast<void>(there->messages().receive(soon())), Stopped);
  impactor.reset();
  EXPECT_THROW(static_cast<void>(there->messages().receive(soon())), Stopped);
  DirectDoor another({.listen = local() + "2"});
  EXPECT_THROW(static_cast<void>(std::move(another).open(look)), Stopped);
}

class ServeDirect : public ServeStructure {};

class Mute final : public ImpactorBackend {
  wire::Hello describe() const override { return {}; }
  wire::Ready prepare(const wire::Setup& /*setup*/) override { return {}; }
  void run(const wire::Start& /*start*/, ImpactorLink& /*link*/) override {}
};

TEST(ServeDirectImpactor, DoesNotListen) {
  testing::ScriptedOrchestrator talk(
      [](transport::Channel& channel, const ServeOptions& options) {
        Mute mute;
        return serve_impactor(channel, mute, options);
      },
      {.direct = {{.listen = "ipc:///somewhere"}}});
  const auto error = talk.hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::BAD_INPUT);
  EXPECT_NE(error.text().find("--data-listen ipc:///somewhere: the structure listens"), std::string::npos);
  EXPECT_EQ(talk.exit_code(), 2);
}

TEST_F(ServeDirect, AStructureSaysWhereItListens) {
  const TemporaryDirectory directory;
  const std::string endpoint = "ipc://" + (directory.path() / "data").string();
  auto& talk = orchestrator({.direct = {{.listen = endpoint}}});
  const auto hello = talk.hear<wire::Hello>();
  talk.tell(stop());
  EXPECT_EQ(hello.data_endpoint(), endpoint);
  EXPECT_EQ(std::ranges::count(hello.capabilities(), direct_capability), 1);
}

TEST_F(ServeDirect, WithoutOneNothingIsOffered) {
  auto& talk = orchestrator({.direct = DirectOptions{}});
  const auto hello = talk.hear<wire::Hello>();
  talk.tell(stop());
  EXPECT_EQ(hello.data_endpoint(), "");
  EXPECT_EQ(std::ranges::count(hello.capabilities(), direct_capability), 0);
}

TEST_F(ServeDirect, AStartThatNamesOneThatWasNotOfferedIsRefused) {
  auto& talk = orchestrator();
  talk.hear<wire::Hello>();
  talk.tell(setup());
  talk.hear<wire::Ready>();
  auto direct = start();
  direct.mutable_direct()->set_endpoint("ipc:///nowhere");
  talk.tell(direct);
  EXPECT_NE(talk.hear<wire::Error>().text().find("which this participant did not offer"), std::string::npos);
  EXPECT_EQ(talk.exit_code(), 4);
}

// The orchestrator listens: what goes to the other side comes to it as well.
TEST_F(ServeDirect, TheOrchestratorGetsACopyOfWhatTheOtherSideGets) {
  const TemporaryDirectory directory;
  auto& talk = orchestrator({.direct = {{.listen = "ipc://" + (directory.path() / "data").string()}}});
  auto direct = start();
  direct.mutable_direct()->set_endpoint(talk.hear<wire::Hello>().data_endpoint());
  talk.tell(setup());
  talk.hear<wire::Ready>();
  talk.tell(direct);
  const auto impactor = connect_directly(direct.direct().endpoint(), {}, [] {});
  impactor->messages().send(forces(0));
  const wire::Frame* frame = impactor->messages().receive(soon());
  ASSERT_NE(frame, nullptr);
  wire::Kinematics seen;
  impactor->messages().take(*frame, seen, 1);
  EXPECT_EQ(talk.hear<wire::Kinematics>(1).SerializeAsString(), seen.SerializeAsString());
  talk.hear<wire::Report>(0);
  talk.hear<wire::Snapshot>(0);
  talk.tell(stop());
  talk.hear<wire::Finished>();
  EXPECT_EQ(talk.exit_code(), 0);
}

}  // namespace
}  // namespace grainstep::participant
