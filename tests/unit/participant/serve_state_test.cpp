/// @file A structure that can be saved: what it says of its state, and how it goes on from one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "one_node.hpp"
#include "wire/state_parts.hpp"

namespace grainstep::participant {
namespace {

using ::testing::HasSubstr;

/// Its state is how many windows it has seen.
class Counting final : public StructureBackend {
 public:
  wire::Hello describe() const override {
    wire::Hello hello = node_.describe();
    if (can_save) hello.add_capabilities("state");
    return hello;
  }
  wire::Ready prepare(const wire::Setup& setup) override { return node_.prepare(setup); }
  void start(const wire::Start& start) override { node_.start(start); }
  void advance(const wire::Forces& /*forces*/, Due /*due*/, wire::Kinematics& next) override {
    ++seen;
    for (int i = 0; i < 2; ++i) {
      next.add_position(static_cast<double>(seen));
      next.add_velocity(0.0);
    }
  }
  void report(wire::Report& report) override { report.mutable_timing()->set_steps(seen); }
  void snapshot(wire::Snapshot& /*snapshot*/) override {}
  void complete() override {}
  std::string save() override { return std::to_string(seen); }
  void restore(std::string_view state) override {
    if (state.empty() || state.find_first_not_of("0123456789") != std::string_view::npos) {
      throw std::range_error("no number");
    }
    seen = std::stoull(std::string(state));
  }

  std::uint64_t seen = 0;
  bool can_save = true;

 private:
  OneNode node_;
};

class ServeState : public ServeStructure {
 protected:
  testing::ScriptedOrchestrator& begin() {
    conversation_ = std::make_unique<testing::ScriptedOrchestrator>(
        [this](transport::Channel& channel, const ServeOptions& options) {
          return serve_structure(channel, counting, options);
        });
    conversation_->hear<wire::Hello>();
    return *conversation_;
  }
  testing::ScriptedOrchestrator& run_of_three() {
    auto& talk = begin();
    talk.tell(setup());
    talk.hear<wire::Ready>();
    wire::Start three = start();
    three.set_report_every(3);
    three.set_snapshot_every(0.0);
    talk.tell(three);
    return talk;
  }
  static wire::Forces marked(std::uint64_t window) {
    wire::Forces out = forces(window);
    out.set_save(true);
    return out;
  }
  /// The state at the end of window 1.
  wire::State state_of_window_1() {
    auto& talk = run_of_three();
    talk.tell(forces(0));
    talk.hear<wire::Kinematics>(1);
    talk.hear<wire::Report>(0);
    talk.tell(marked(1));
    talk.hear<wire::Kinematics>(2);
    auto state = talk.hear<wire::State>(1);
    EXPECT_EQ(talk.hear<wire::Saved>(1).chunks(), 1U);
    talk.tell(stop());
    talk.hear<wire::Finished>();
    EXPECT_EQ(talk.exit_code(), 0);
    return state;
  }
  static wire::Setup restoring(std::uint32_t chunks = 1) {
    wire::Setup out = setup();
    out.mutable_restore()->set_window(1);
    out.mutable_restore()->set_chunks(chunks);
    return out;
  }
  static wire::Start start_at(std::uint64_t first) {
    wire::Start out = start();
    out.set_first_window(first);
    out.set_report_every(3);
    out.set_snapshot_every(0.0);
    return out;
  }

  Counting counting;

 private:
  std::unique_ptr<testing::ScriptedOrchestrator> conversation_;
};

TEST_F(ServeState, GoesOnWithTheKinematicsThatItHadSaid) {
  const wire::State state = state_of_window_1();
  counting = {};
  auto& talk = begin();
  talk.tell(restoring());
  talk.tell(state);
  talk.hear<wire::Ready>();
  talk.tell(start_at(2));
  EXPECT_EQ(talk.hear<wire::Kinematics>(2).position(0), 2.0);
  talk.tell(forces(2));
  EXPECT_EQ(talk.hear<wire::Kinematics>(3).position(0), 3.0);
  talk.tell(marked(3));
  EXPECT_EQ(talk.hear<wire::Report>(3).timing().steps(), 4U) << "and no state: it was the last window";
  talk.tell(stop());
  talk.hear<wire::Finished>();
  EXPECT_EQ(talk.exit_code(), 0);
}

TEST_F(ServeState, AStateThatTheModelRefusesIsBadInput) {
  wire::State state = state_of_window_1();
  state.set_data(state.data().substr(0, state.data().size() - 1));
  state.set_checksum([&state] {
    // As whoever sends it makes it.
    auto [near, far] = transport::make_in_process_pair({.first = "a", .second = "b"});
    wire::MessageChannel sender(*near, "b");
    wire::MessageChannel reader(*far, "a");
    wire::send_state(sender, 1, state.data());
    wire::State seen;
    reader.take(*reader.receive(grainstep::testing::soon()), seen);
    return seen.checksum();
  }());
  auto& talk = begin();
  talk.tell(restoring());
  talk.tell(state);
  talk.hear<wire::Ready>();
  talk.tell(start_at(2));
  const auto error = talk.hear<wire::Error>();
  EXPECT_EQ(error.kind(), wire::Error::BAD_INPUT);
  EXPECT_THAT(error.text(), HasSubstr("the state to go on from is not one of this model: the part 'backend'"));
  EXPECT_EQ(talk.exit_code(), 2);
}

TEST_F(ServeState, ADamagedStateIsRefusedBeforeAModelIsBuilt) {
  wire::State state = state_of_window_1();
  state.mutable_data()->back() ^= 1;
  auto& talk = begin();
  talk.tell(restoring());
  talk.tell(state);
  EXPECT_THAT(talk.hear<wire::Error>().text(), HasSubstr("State of window 1: part 0 is damaged"));
  EXPECT_EQ(talk.exit_code(), 4);
}

TEST_F(ServeState, ARunBeginsWhereItsStateEnds) {
  {
    auto& talk = begin();
    talk.tell(setup());
    talk.hear<wire::Ready>();
    talk.tell(start_at(1));
    EXPECT_THAT(talk.hear<wire::Error>().text(),
                HasSubstr("Start begins at window 1, expected 0: no state was given to go on from"));
    EXPECT_EQ(talk.exit_code(), 4);
  }
  const wire::State state = state_of_window_1();
  auto& talk = begin();
  talk.tell(restoring());
  talk.tell(state);
  talk.hear<wire::Ready>();
  talk.tell(start_at(3));
  EXPECT_THAT(talk.hear<wire::Error>().text(), HasSubstr("Start begins at window 3, expected 2"));
  EXPECT_EQ(talk.exit_code(), 4);
}

TEST_F(ServeState, WhoCannotSaysSo) {
  counting.can_save = false;
  {
    auto& talk = begin();
    talk.tell(restoring());
    EXPECT_THAT(talk.hear<wire::Error>().text(), HasSubstr("a run that continues, which this participant cannot"));
    EXPECT_EQ(talk.exit_code(), 4);
  }
  auto& talk = run_of_three();
  talk.tell(marked(0));
  EXPECT_THAT(talk.hear<wire::Error>().text(), HasSubstr("ask for a state, which this participant cannot give"));
  EXPECT_EQ(talk.exit_code(), 4);
}

TEST(StateParts, OfMoreThanIsBorneOrOfAnotherWindowAreRefused) {
  wire::State part;
  part.set_window(3);
  part.set_data("sand");
  wire::StateParts few("impactor", 3, 3);
  wire::StateParts other("impactor", 4, 100);
  const auto refusal = [&part](wire::StateParts& parts) -> std::string {
    try {
      parts.add(part);
    } catch (const PeerError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal(few), HasSubstr("impactor: State of window 3: more than 3 bytes"));
  EXPECT_THAT(refusal(other), HasSubstr("State of window 4: a part is of window 3"));
}

}  // namespace
}  // namespace grainstep::participant
