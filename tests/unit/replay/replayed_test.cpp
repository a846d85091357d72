// Both players as the orchestrator drives them: books that close, states that leave nothing out, and what they refuse.
#include <gmock/gmock.h>

#include <map>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "participant/schedule.hpp"
#include "replay/replayed_load.hpp"
#include "replay/replayed_surface.hpp"
#include "tests/unit/replay/recorded.hpp"

namespace grainstep::replay {
namespace {

using testing::HasSubstr;

wire::Setup setup_of(bool impactor, const std::filesystem::path& file) {
  wire::Setup setup;
  setup.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  setup.set_depth(0.5);
  setup.set_dimension(2);
  setup.set_scene_hash(9);
  if (impactor) {
    scene::Impactor& part = *setup.mutable_impactor()->mutable_impactor();
    part.set_type(scene::Impactor::TYPE_REPLAY);
    part.mutable_replay()->set_file(file.string());
    *setup.mutable_impactor()->mutable_surface() = test::face({0.0, 1.0, 2.0});
  } else {
    scene::Structure& part = *setup.mutable_structure()->mutable_structure();
    part.set_type(scene::Structure::TYPE_REPLAY);
    part.mutable_replay()->set_file(file.string());
  }
  return setup;
}

wire::Start start_of(double window, std::uint64_t windows, std::uint64_t first = 0) {
  wire::Start start;
  start.set_window(window);
  start.set_windows(windows);
  start.set_impactor_steps(2);
  start.set_structure_steps(1);
  start.set_report_every(1);
  start.set_first_window(first);
  return start;
}

/// A structure that moves as the recorded one did; keeps what the load says.
class Mirror final : public participant::ImpactorLink {
 public:
  explicit Mirror(const wire::Start& start) : start_(start) {}

  const wire::Kinematics* surface(std::uint64_t n) override {
    kinematics_ = test::kinematics(n);
    return &kinematics_;
  }
  participant::Due due(std::uint64_t n) const override { return participant::due_at(start_, n); }
  void send(const wire::Forces& message) override { told[message.window()] += message.SerializeAsString(); }
  void send(wire::Report& message) override {
    last = message;
    told[message.window()] += message.SerializeAsString();
  }
  void send(const wire::Snapshot& message) override { told[message.window()] += message.SerializeAsString(); }
  bool wants_state(std::uint64_t n) override {
    asked_of_ = n;
    return save_at.contains(n);
  }
  void send_state(std::string_view state) override { states[asked_of_] = state; }
  std::optional<std::string_view> state() const override { return from; }

  std::set<std::uint64_t> save_at;
  std::optional<std::string> from;
  std::map<std::uint64_t, std::string> told, states;  // by window
  wire::Report last;

 private:
  wire::Start start_;
  wire::Kinematics kinematics_;
  std::uint64_t asked_of_ = 0;
};

TEST(ReplayedLoad, GivesTheImpulseAndTheWorkOfTheRecord) {
  const test::Recorded recorded;
  ReplayedLoad load;
  const wire::Ready ready = load.prepare(setup_of(true, recorded.directory()));
  EXPECT_EQ(ready.preferred_step(), test::about().impactor().preferred_step()) << "both sides agree as they did";
  EXPECT_EQ(ready.scene_hash(), 9U);
  const wire::Start start = start_of(test::window, test::windows);
  Mirror mirror(start);
  load.run(start, mirror);
  double given = 0.0, work = 0.0;
  for (std::uint64_t n = 0; n < test::windows; ++n) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double after = test::velocity(n + 1);
      given += test::impulse(n, k, 1);
      work += test::impulse(n, k, 1) * 0.5 * (test::velocity(n) + after);
    }
  }
  EXPECT_NEAR(mirror.last.momentum().interface_impulse(1), -given, 1e-12);
  EXPECT_NEAR(mirror.last.momentum().support_impulse(1), given, 1e-12);
  EXPECT_NEAR(mirror.last.energy().interface_work(), -work, 1e-12);
  EXPECT_NEAR(mirror.last.energy().support_work(), work, 1e-12);
  EXPECT_EQ(mirror.last.energy().kinetic(), 3.5) << "what errors are measured against";
  for (const wire::Observable& one : mirror.last.observable()) {
    if (one.name() == "surface_speed_departure") {
      EXPECT_EQ(one.value(), 0.0) << "it is the recorded surface";
    }
    if (one.name() == "surface_speed_ratio") {
      EXPECT_GT(one.value(), 0.04);
    }
  }
}

TEST(ReplayedLoad, GoesOnFromItsState) {
  const test::Recorded recorded;
  const wire::Setup setup = setup_of(true, recorded.file());
  for (const double window : {test::window, 0.7 * test::window}) {
    const wire::Start start = start_of(window, test::windows);
    Mirror whole(start);
    whole.save_at = {0, 11, test::windows - 1};
    ReplayedLoad load;
    static_cast<void>(load.prepare(setup));
    load.run(start, whole);
    for (const auto& [saved, state] : whole.states) {
      const wire::Start later = start_of(window, test::windows, saved + 1);
      Mirror rest(later);
      rest.from = state;
      ReplayedLoad again;
      static_cast<void>(again.prepare(setup));
      again.run(later, rest);
      ASSERT_EQ(rest.told.size(), test::windows - saved);
      for (const auto& [n, bytes] : rest.told) ASSERT_TRUE(bytes == whole.told.at(n)) << n << " from " << saved;
    }
  }
}

/// All that a structure says under the recorded load; saves at `save`, or goes on from `state`.
struct Said {
  std::map<std::uint64_t, wire::Kinematics> kinematics;  ///< by window
  std::map<std::uint64_t, wire::Report> reports;
  std::string state;
};

Said play(double window, std::uint64_t first, std::uint64_t save, const std::string* state,
          const std::filesystem::path& file) {
  ReplayedSurface surface;
  static_cast<void>(surface.prepare(setup_of(false, file)));
  surface.start(start_of(window, test::windows, first));
  if (state != nullptr) surface.restore(*state);
  Said said;
  for (std::uint64_t n = first; n <= test::windows; ++n) {
    wire::Kinematics next;
    surface.advance(test::forces(n), {.report = true, .snapshot = true}, next);
    if (n < test::windows) said.kinematics[n + 1] = next;
    surface.report(said.reports[n]);
    wire::Snapshot snapshot;
    surface.snapshot(snapshot);
    EXPECT_EQ(snapshot.position_size(), 6);
    surface.complete();
    if (n == save) said.state = surface.save();
  }
  return said;
}

TEST(ReplayedSurface, MovesAsItDid) {
  const test::Recorded recorded;
  const Said said = play(test::window, 0, 999, nullptr, recorded.file());
  for (const auto& [n, kinematics] : said.kinematics) {
    const wire::Kinematics was = test::kinematics(n);
    for (int i = 0; i < 6; ++i) {
      ASSERT_EQ(kinematics.position(i), was.position(i)) << n;
      ASSERT_EQ(kinematics.velocity(i), was.velocity(i)) << n;
    }
  }
  double given = 0.0;
  for (std::uint64_t n = 0; n < test::windows; ++n)
    for (std::size_t k = 0; k < 3; ++k) given += test::impulse(n, k, 1);
  EXPECT_NEAR(said.reports.at(test::windows).momentum().interface_impulse(1), given, 1e-12);
}

// Evenly between two rows: the velocity is that of the way, which the orchestrator checks.
TEST(ReplayedSurface, InOtherWindowsItsVelocityIsThatOfItsWay) {
  const test::Recorded recorded;
  const double window = 0.37 * test::window;
  const Said said = play(window, 0, 999, nullptr, recorded.file());
  double height = 0.0;
  for (const auto& [n, kinematics] : said.kinematics) {
    EXPECT_NEAR(kinematics.position(1) - height, kinematics.velocity(1) * window, 1e-15);
    height = kinematics.position(1);
  }
  EXPECT_NEAR(height, 0.2 * test::kinematics(14).position(1) + 0.8 * test::kinematics(15).position(1), 1e-15);
}

TEST(ReplayedSurface, GoesOnFromItsState) {
  const test::Recorded recorded;
  for (const double window : {test::window, 0.7 * test::window}) {
    const Said whole = play(window, 0, 11, nullptr, recorded.file());
    const Said rest = play(window, 12, 999, &whole.state, recorded.file());
    for (const auto& [n, kinematics] : rest.kinematics)
      ASSERT_TRUE(kinematics.SerializeAsString() == whole.kinematics.at(n).SerializeAsString()) << n;
    for (const auto& [n, report] : rest.reports)
      ASSERT_TRUE(report.SerializeAsString() == whole.reports.at(n).SerializeAsString()) << n;
  }
}

TEST(ReplayedSurface, IsNotPlayedBeyondItsEnd) {
  const test::Recorded recorded;
  ReplayedSurface surface;
  static_cast<void>(surface.prepare(setup_of(false, recorded.file())));
  EXPECT_NO_THROW(surface.start(start_of(test::window, test::windows)));
  EXPECT_THROW(surface.start(start_of(test::window, test::windows + 1)), InputError);
}

std::string refusal(const wire::Setup& setup) {
  try {
    if (setup.has_impactor()) static_cast<void>(ReplayedLoad().prepare(setup));
    if (setup.has_structure()) static_cast<void>(ReplayedSurface().prepare(setup));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Replayed, ARecordOfAnotherKindOfSceneIsRefused) {
  const test::Recorded recorded;
  for (const bool impactor : {true, false}) {
    const wire::Setup fits = setup_of(impactor, recorded.file());
    EXPECT_EQ(refusal(fits), "none");
    wire::Setup other = fits;
    other.set_symmetry(scene::SYMMETRY_AXISYMMETRIC);
    EXPECT_THAT(refusal(other), HasSubstr("was recorded with symmetry plane_strain, this scene has axisymmetric"));
    other = fits;
    other.set_dimension(3);
    EXPECT_THAT(refusal(other), HasSubstr("dimension 2, this scene has 3"));
    other = fits;
    other.set_depth(1.0);
    EXPECT_THAT(refusal(other), HasSubstr("a depth of 0.5 m, this scene has 1 m"));
    other = fits;
    other.set_mirror(true);
    EXPECT_THAT(refusal(other), HasSubstr("an extent of full, this scene has half, with a mirror"));
    other = fits;
    if (impactor) {
      other.mutable_impactor()->mutable_impactor()->set_type(scene::Impactor::TYPE_SLUG);
    } else {
      other.mutable_structure()->mutable_structure()->set_type(scene::Structure::TYPE_BEAM);
    }
    EXPECT_THAT(refusal(other), HasSubstr("grainstep-replay plays `replay` and nothing else"));
  }
}

}  // namespace
}  // namespace grainstep::replay
