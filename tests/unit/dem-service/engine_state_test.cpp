// A run of either engine that is saved and goes on elsewhere gives the bits of one that was not.
#include <gtest/gtest.h>

#include <string>

#include "contact/moving_surface.hpp"
#include "engine_rig.hpp"
#include "slice_rig.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

struct Case {
  const char* name;
  wire::Setup setup;
  std::uint32_t steps = 1;  ///< in a window
};

wire::Setup discs() {
  wire::Setup setup = reference_setup();
  set_flat_surface(setup, 0.1, 40);
  return setup;
}

Case equal_discs() { return {"equal discs", discs(), 3}; }

Case unequal_discs() {
  Case out{"unequal discs, several blocks", discs()};
  slug_of(out.setup).mutable_particle()->set_diameter(0.4e-3);
  auto& sizes = *slug_of(out.setup).mutable_size_distribution();
  sizes.set_by(scene::SizeDistribution::BY_NUMBER);
  sizes.mutable_uniform()->set_width(0.5);
  return out;
}

Case confined_half() {
  Case out{"confined, mirrored, over chords", discs(), 2};
  out.setup.set_mirror(true);
  slug_of(out.setup).set_confined(true);
  set_surface(out.setup, {{{0.0, 0.0}}, {{0.0004, 0.0}}, {{0.0008, 0.0}}, {{0.1, 0.0}}});
  return out;
}

Case spheres() {
  Case out{"a slice of spheres", slice_setup()};
  set_rings(out.setup, 0.1, 40);
  return out;
}

/// Sinks slowly, so that the surface's own state counts.
Motion sinking(double per_window) {
  return [per_window](std::uint64_t window, const Vec2& start) {
    return Vec2{{start[0], start[1] - per_window * static_cast<double>(window) * (start[0] > 0.0 ? 2.0 : 1.0)}};
  };
}

ScriptedLink run_on(const Case& of, const wire::Start& start, std::set<std::uint64_t> save_at,
                    std::optional<std::string> from, int threads = 1) {
  ScriptedLink link(of.setup, start, sinking(start.window() * 1.0));
  link.save_at = std::move(save_at);
  link.resume_from = std::move(from);
  if (!native_is_tested()) {
    SlugEngine(alone(), of.setup).run(start, &link);
    return link;
  }
  const SlugModel model = model_of(of.setup);
  native::make_engine(model, of.setup.impactor(),
                      lay_out(model, contact::MovingSurface(of.setup.impactor().surface()).now()), threads)
      ->run(start, link);
  return link;
}

template <typename Message>
std::string bytes_from(const std::vector<Message>& messages, std::uint64_t window) {
  std::string bytes;
  for (const Message& message : messages) {
    if (message.window() >= window) message.AppendToString(&bytes);
  }
  return bytes;
}

class EngineState : public ::testing::TestWithParam<Case (*)()> {};
INSTANTIATE_TEST_SUITE_P(, EngineState, ::testing::Values(equal_discs, unequal_discs, confined_half, spheres),
                         [](const auto& of) { return "Case" + std::to_string(of.index); });

TEST_P(EngineState, ARunThatGoesOnGivesTheBitsOfOneThatWasNotInterrupted) {
  const Case of = GetParam()();
  SCOPED_TRACE(of.name);
  const SlugModel model = model_of(of.setup);
  const scene::Slug& slug = of.setup.impactor().impactor().slug();
  const double step = model.preferred_step;
  const auto windows = static_cast<std::uint64_t>(1.3 * slug.height() / slug.speed() / step / of.steps);
  wire::Start start = start_of(step, windows, of.steps);
  start.set_report_every(static_cast<double>(windows) / 20.0);
  const std::set<std::uint64_t> saved = {0, 1, windows / 7, windows / 2, windows - 1};
  const ScriptedLink whole = run_on(of, start, saved, std::nullopt);
  const ScriptedLink unasked = run_on(of, start, {}, std::nullopt);
  EXPECT_TRUE(bytes_from(whole.forces, 0) == bytes_from(unasked.forces, 0)) << "saving changes the run";
  ASSERT_EQ(whole.states.size(), saved.size());
  for (const std::uint64_t window : saved) {
    wire::Start rest = start;
    rest.set_first_window(window + 1);
    const ScriptedLink gone_on = run_on(of, rest, {}, whole.states.at(window), 2);
    EXPECT_EQ(gone_on.forces.size(), windows - window);
    EXPECT_TRUE(bytes_from(gone_on.forces, 0) == bytes_from(whole.forces, window + 1)) << "from window " << window;
    EXPECT_TRUE(bytes_from(gone_on.reports, 0) == bytes_from(whole.reports, window + 1)) << "from window " << window;
    EXPECT_TRUE(bytes_from(gone_on.snapshots, 0) == bytes_from(whole.snapshots, window + 1))
        << "from window " << window;
  }
}

TEST(EngineStateOf, AnotherModelIsRefused) {
  const Case of = equal_discs();
  wire::Start start = start_of(model_of(of.setup).preferred_step, 20);
  std::string state = run_on(of, start, {10}, std::nullopt).states.at(10);
  start.set_first_window(11);
  EXPECT_THROW(run_on(of, start, {}, state.substr(0, state.size() / 2)), std::range_error);
  EXPECT_THROW(run_on(of, start, {}, state + "x"), std::range_error);
  Case other = of;
  slug_of(other.setup).set_height(0.03);
  EXPECT_THROW(run_on(other, start, {}, state), std::range_error);
}

}  // namespace
}  // namespace grainstep::dem
