// The conversation before the first step: who is there, what was prepared, and how long each is waited for.
#include "orchestrator/session/session.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <limits>
#include <optional>
#include <ostream>
#include <sstream>
#include <thread>

#include "base/error.hpp"
#include "fake_backends.hpp"
#include "hand_played.hpp"
#include "ledger/ledger.hpp"
#include "participant/serve.hpp"
#include "patience.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

TEST(Introduction, NamesWhoNeverCame) {
  ByHand impactor("impactor");
  ByHand structure("structure");
  EventLoop loop;
  Hub hub(*impactor.near_, *structure.near_, loop);
  const scene::Scene scene;
  Session session(hub, {.scene = scene, .hash = 1, .end = 1.0}, {.connect_s = 0.1, .step_s = 0.1, .stop_s = 0.1});
  fake::SpringStructure spring;
  structure.messages_->send(spring.describe());
  try {
    session.introduce();
    FAIL() << "nobody came";
  } catch (const PeerError& error) {
    EXPECT_EQ(error.peer(), "impactor");
    EXPECT_THAT(error.what(), HasSubstr("did not connect within"));
  }
}

/// Both peers by hand: what they say is there before it is asked for.
class Handshake : public ::testing::Test {
 protected:
  static constexpr std::uint64_t hash = 77;

  Handshake() : hub_(*impactor_.near_, *structure_.near_, loop_) {
    hello_impactor_ = fake::BallImpactor().describe();
    hello_structure_ = fake::SpringStructure().describe();
    wire::Setup setup;
    setup.set_scene_hash(hash);
    ready_impactor_ = fake::BallImpactor().prepare(setup);
    ready_structure_ = fake::SpringStructure().prepare(setup);
    scene_.set_depth(fake::depth);
    scene_.mutable_output()->set_rows(2);
  }

  Session session() { return Session(hub_, {.scene = scene_, .hash = hash, .end = 1.0}, deadlines_); }

  std::string introduction() {
    impactor_.messages_->send(hello_impactor_);
    structure_.messages_->send(hello_structure_);
    return refusal_of([&] { session().introduce(); });
  }

  /// The structure is prepared first: where it is refused, the impactor is not asked.
  std::string preparation_of_structure() {
    structure_.messages_->send(ready_structure_);
    return refusal_of([&] { static_cast<void>(session().prepare()); });
  }

  /// The impactor answers when it is asked.
  std::string preparation() {
    const auto answer = std::async(std::launch::async, [this] {
      const wire::Frame* frame = impactor_.messages_->receive(transport::in(std::chrono::seconds(60)));
      if (frame == nullptr) return;
      impactor_.messages_->take(*frame, for_impactor_);
      impactor_.messages_->send(ready_impactor_);
    });
    return preparation_of_structure();
  }

  static std::string refusal_of(const std::function<void()>& act) {
    try {
      act();
    } catch (const PeerError& error) {
      return error.what();
    } catch (const InputError& error) {
      return std::string("bad input: ") + error.what();
    }
    return "";
  }

  /// What a peer has been sent next.
  template <class Message>
  static Message told(ByHand& peer) {
    Message message;
    const wire::Frame* frame = peer.messages_->receive(transport::Clock::now());
    EXPECT_NE(frame, nullptr);
    if (frame != nullptr) peer.messages_->take(*frame, message);
    return message;
  }

  ByHand impactor_{"impactor"};
  ByHand structure_{"structure"};
  EventLoop loop_;
  Hub hub_;
  scene::Scene scene_;
  Deadlines deadlines_{.connect_s = 20.0, .step_s = 20.0, .stop_s = 20.0};
  wire::Hello hello_impactor_, hello_structure_;
  wire::Ready ready_impactor_, ready_structure_;
  wire::Setup for_impactor_;
};

TEST_F(Handshake, TakesBothAsTheyShouldBe) {
  EXPECT_EQ(introduction(), "");
  EXPECT_EQ(preparation(), "");
}

TEST_F(Handshake, RefusesTheWrongRole) {
  hello_impactor_ = hello_structure_;
  EXPECT_THAT(introduction(), HasSubstr("impactor: spring: says that it is the STRUCTURE"));
}

TEST_F(Handshake, RefusesAnotherProtocol) {
  hello_structure_.set_protocol(wire::PROTOCOL_VERSION + 1);
  EXPECT_THAT(introduction(),
              HasSubstr("structure: spring: speaks protocol version " + std::to_string(wire::PROTOCOL_VERSION + 1) +
                        ", this program version " + std::to_string(wire::PROTOCOL_VERSION)));
}

TEST_F(Handshake, RefusesAnotherDimension) {
  hello_impactor_.clear_dimension();
  hello_impactor_.add_dimension(3);
  EXPECT_THAT(introduction(),
              HasSubstr("bad input: symmetry: the scene has 2 dimensions, but the impactor (ball) computes in 3"));
}

TEST_F(Handshake, RefusesAPlaceForDataThatIsNone) {
  hello_structure_.add_capabilities("direct");
  hello_structure_.set_data_endpoint("http://somewhere");
  EXPECT_THAT(introduction(), HasSubstr("structure: Hello.data_endpoint: http://somewhere: "));
}

TEST_F(Handshake, RefusesAPlaceForDataWithoutEnd) {
  hello_structure_.add_capabilities("direct");
  hello_structure_.set_data_endpoint("tcp://" + std::string(5000, 'a') + ":1");
  EXPECT_THAT(introduction(), HasSubstr("structure: Hello.data_endpoint: 5008 characters"));
}

TEST_F(Handshake, NamesTheKeyThatAsksForWhatAPeerCannot) {
  scene_.set_symmetry(scene::SYMMETRY_AXISYMMETRIC);
  EXPECT_THAT(introduction(), HasSubstr("bad input: symmetry: asks for 'axisymmetric', which the impactor (ball) does "
                                        "not say it can compute; its capabilities: external, plane_strain"));
}

TEST_F(Handshake, AStructureThatCannotIsRefusedAsWell) {
  scene_.mutable_structure()->set_type(scene::Structure::TYPE_BEAM);
  EXPECT_THAT(introduction(), HasSubstr("bad input: structure.type: asks for 'beam', which the structure (spring)"));
}

TEST_F(Handshake, RefusesAModelOfAnotherScene) {
  ready_structure_.set_scene_hash(hash + 1);
  EXPECT_THAT(preparation_of_structure(), HasSubstr("structure: prepared scene 78, this run is of scene 77"));
}

TEST_F(Handshake, RefusesAnImpactorOfAnotherScene) {
  ready_impactor_.set_scene_hash(0);
  EXPECT_THAT(preparation(), HasSubstr("impactor: prepared scene 0, this run is of scene 77"));
}

TEST_F(Handshake, RefusesStepsThatAreNone) {
  ready_structure_.set_preferred_step(0.0);
  EXPECT_THAT(preparation_of_structure(), HasSubstr("both must be above zero"));
}

TEST_F(Handshake, RefusesAPreferredStepBeyondTheStableOne) {
  ready_structure_.set_preferred_step(2e-3);
  EXPECT_THAT(preparation_of_structure(), HasSubstr("prefers a step of 0.002 s, but is stable only up to 0.001 s"));
}

/// What a participant may say of itself, and what is made of it.
struct WrongReady {
  const char* name;
  std::function<void(wire::Ready&)> change;
  const char* text;
};

void PrintTo(const WrongReady& one, std::ostream* out) { *out << one.name; }

class WrongSurface : public Handshake, public ::testing::WithParamInterface<WrongReady> {};

TEST_P(WrongSurface, IsRefused) {
  GetParam().change(ready_structure_);
  EXPECT_THAT(preparation_of_structure(), HasSubstr(std::string("structure: ") + GetParam().text));
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Handshake, WrongSurface,
    ::testing::Values(
        WrongReady{"dimension", [](wire::Ready& r) { r.mutable_surface()->set_dimension(3); },
                   "Ready.surface has dimension 3, the run has 2"},
        WrongReady{"no_nodes", [](wire::Ready& r) { r.mutable_surface()->clear_position(); },
                   "Ready.surface has no nodes"},
        WrongReady{"half_a_node", [](wire::Ready& r) { r.mutable_surface()->add_position(1.0); },
                   "Ready.surface.position holds 5 numbers, expected 4"},
        WrongReady{"other_velocities", [](wire::Ready& r) { r.mutable_surface()->add_velocity(1.0); },
                   "Ready.surface.velocity holds 5 numbers, expected 4"},
        WrongReady{"no_facets", [](wire::Ready& r) { r.mutable_surface()->clear_facet(); },
                   "Ready.surface.facet holds 0 node numbers"},
        WrongReady{"half_a_facet", [](wire::Ready& r) { r.mutable_surface()->add_facet(0); },
                   "Ready.surface.facet holds 3 node numbers, expected 2 for each facet"},
        WrongReady{"node_that_is_not", [](wire::Ready& r) { r.mutable_surface()->set_facet(1, 2); },
                   "Ready.surface: facet 0 names node 2, but the surface has 2 nodes"},
        WrongReady{"no_length", [](wire::Ready& r) { r.mutable_surface()->set_facet(1, 0); },
                   "Ready.surface: facet 0 has no length"},
        WrongReady{"infinite_place", [](wire::Ready& r) { r.mutable_surface()->set_position(2, 1.0 / 0.0); },
                   "Ready.surface.position[2] = inf"},
        WrongReady{"mass", [](wire::Ready& r) { r.set_mass(not_a_number); }, "Ready.mass = nan"},
        WrongReady{"negative", [](wire::Ready& r) { r.set_contact_mass(-1.0); }, "Ready.contact_mass is -1"},
        WrongReady{"ledger", [](wire::Ready& r) { r.clear_ledger(); }, "Ready.ledger is not said"}),
    [](const auto& one) { return std::string(one.param.name); });

// A ring's area is what pressures are divided by.
TEST_F(Handshake, RefusesRingsOnTheAxisOrBeyondIt) {
  scene_.set_symmetry(scene::SYMMETRY_AXISYMMETRIC);
  for (const double radius : {0.0, -2.0}) {
    ready_structure_.mutable_surface()->set_position(0, 0.0);
    ready_structure_.mutable_surface()->set_position(1, 1.0);
    ready_structure_.mutable_surface()->set_position(2, radius);
    EXPECT_THAT(preparation_of_structure(), HasSubstr("structure: Ready.surface: facet 0 reaches from r = 0 m to"));
  }
}

TEST_F(Handshake, TheSetupHoldsTheSceneAndTheStructuresAnswer) {
  scene_.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  scene_.mutable_structure()->set_extent(scene::Structure::EXTENT_HALF);
  scene_.mutable_structure()->set_half_span(0.25);
  scene_.mutable_impactor()->mutable_slug()->set_speed(123.0);
  scene_.mutable_guards()->set_overlap(0.5);
  ready_structure_.set_free_mass(3.5);
  ASSERT_EQ(preparation(), "");
  const auto for_structure = told<wire::Setup>(structure_);
  for (const wire::Setup& setup : {for_structure, for_impactor_}) {
    EXPECT_EQ(setup.protocol(), wire::PROTOCOL_VERSION);
    EXPECT_EQ(setup.scene_hash(), hash);
    EXPECT_EQ(setup.symmetry(), scene::SYMMETRY_PLANE_STRAIN);
    EXPECT_EQ(setup.depth(), fake::depth);
    EXPECT_TRUE(setup.mirror());
  }
  EXPECT_EQ(for_structure.structure().structure().half_span(), 0.25);
  EXPECT_EQ(for_structure.structure().guards().overlap(), 0.5);
  EXPECT_EQ(for_impactor_.impactor().impactor().slug().speed(), 123.0);
  EXPECT_EQ(for_impactor_.impactor().guards().overlap(), 0.5);
  EXPECT_EQ(for_impactor_.impactor().free_mass(), 3.5);
  EXPECT_EQ(for_impactor_.impactor().surface().SerializeAsString(), ready_structure_.surface().SerializeAsString());
}

// A wait and what is said of it are one number: a longer wait would say so.
TEST_F(Handshake, SilenceIsBorneForTheStepDeadline) {
  deadlines_.step_s = 1.0;
  EXPECT_THAT(refusal_of([&] { static_cast<void>(session().prepare()); }),
              HasSubstr("structure: did not prepare its model within 1 s"));
  StepPlan plan;
  plan.windows = 3;
  plan.window = 1e-3;
  Witness witness;
  Session talk = session();
  EXPECT_THAT(refusal_of([&] { talk.run(plan, witness); }), HasSubstr("impactor: said nothing for 1 s at window 0"));
}

TEST(HubDeadline, IsThatManySecondsFromNow) {
  const auto wait = std::chrono::seconds(20);
  const auto before = transport::Clock::now();
  const Hub::Until until = Hub::within(20.0);
  const auto after = transport::Clock::now();
  EXPECT_GE(until(), before + wait);
  EXPECT_LE(until(), after + wait);
  EXPECT_EQ(until(), until());
}

// docs/user/running.md names them.
TEST(HubDeadline, DefaultsAreTheDocumentedOnes) {
  const Deadlines usual;
  EXPECT_EQ(usual.connect_s, 120.0);
  EXPECT_EQ(usual.step_s, 300.0);
  EXPECT_EQ(usual.stop_s, 5.0);
}

}  // namespace
}  // namespace grainstep::orchestrator
