// Our impactors without particles, saved and gone on with elsewhere, give the bits of a run that was not interrupted.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

#include "../../support/foam_rig.hpp"
#include "base/error.hpp"
#include "fe-service/load/prescribed_load.hpp"

namespace grainstep::fe {
namespace {

/// Plays a face of four nodes that sinks and slides, ever faster, and keeps what it is sent.
class Face final : public participant::ImpactorLink {
 public:
  explicit Face(wire::Start start) : start_(std::move(start)) {}

  [[nodiscard]] static wire::Surface initial() {
    wire::Surface surface;
    surface.set_dimension(2);
    for (int k = 0; k < 4; ++k) {
      surface.add_position(0.05 * k);
      surface.add_position(0.0);
      for (int c = 0; c < 2; ++c) surface.add_velocity(0.0);
    }
    for (const std::uint32_t node : {0U, 1U, 1U, 2U, 2U, 3U}) surface.add_facet(node);
    return surface;
  }

  const wire::Kinematics* surface(std::uint64_t window) override {
    const wire::Surface start = initial();
    kinematics_.Clear();
    kinematics_.set_window(window);
    const auto n = static_cast<double>(window);
    for (int i = 0; i < start.position_size(); ++i) {
      const double along = i % 2 == 0 ? 1e-9 : -4e-9 * (1 + i);
      kinematics_.add_position(start.position(i) + along * n * n);
      kinematics_.add_velocity(along * (2.0 * n - 1.0) / start_.window());
    }
    return &kinematics_;
  }
  participant::Due due(std::uint64_t window) const override { return participant::due_at(start_, window); }
  void send(const wire::Forces& forces) override { told[forces.window()] += forces.SerializeAsString(); }
  void send(wire::Report& report) override { told[report.window()] += report.SerializeAsString(); }
  void send(const wire::Snapshot& shot) override { told[shot.window()] += shot.SerializeAsString(); }
  bool wants_state(std::uint64_t window) override {
    asked_of_ = window;
    return save_at.contains(window);
  }
  void send_state(std::string_view state) override { states[asked_of_] = state; }
  std::optional<std::string_view> state() const override { return resume_from; }

  std::set<std::uint64_t> save_at;
  std::optional<std::string> resume_from;
  std::map<std::uint64_t, std::string> told, states;  ///< by window

 private:
  wire::Start start_;
  wire::Kinematics kinematics_;
  std::uint64_t asked_of_ = 0;
};

constexpr std::uint64_t windows = 400;

wire::Setup setup_of(const scene::Impactor& impactor, scene::Symmetry symmetry) {
  wire::Setup setup;
  setup.set_symmetry(symmetry);
  setup.set_depth(1e-3);
  setup.set_mirror(symmetry == scene::SYMMETRY_PLANE_STRAIN);
  *setup.mutable_impactor()->mutable_impactor() = impactor;
  setup.mutable_impactor()->mutable_guards()->set_element_quality(0.01);
  *setup.mutable_impactor()->mutable_surface() = Face::initial();
  return setup;
}

/// By its scene's type, which says less than Impactor wants to know.
std::unique_ptr<participant::ImpactorBackend> backend_of(const wire::Setup& setup) {
  if (setup.impactor().impactor().type() == scene::Impactor::TYPE_FOAM) return std::make_unique<FoamImpactor>();
  return std::make_unique<PrescribedLoad>();
}

Face play(const wire::Setup& setup, std::uint64_t first, std::set<std::uint64_t> save_at,
          std::optional<std::string> from) {
  const auto impactor = backend_of(setup);
  const wire::Ready ready = impactor->prepare(setup);
  wire::Start start;
  start.set_impactor_steps(2);
  start.set_window(2.0 * std::min(ready.preferred_step(), 5e-8));
  start.set_windows(windows);
  start.set_structure_steps(1);
  start.set_report_every(7);
  start.set_snapshot_every(31);
  start.set_first_window(first);
  Face face(start);
  face.save_at = std::move(save_at);
  face.resume_from = std::move(from);
  impactor->run(start, face);
  return face;
}

void expect_the_same_bits(const wire::Setup& setup) {
  const std::set<std::uint64_t> saved = {0, 1, 33, 250, windows - 1};
  const Face whole = play(setup, 0, saved, std::nullopt);
  ASSERT_EQ(whole.told.size(), windows + 1);
  EXPECT_TRUE(whole.told == play(setup, 0, {}, std::nullopt).told) << "saving changes the run";
  ASSERT_EQ(whole.states.size(), saved.size());
  for (const std::uint64_t window : saved) {
    const Face rest = play(setup, window + 1, {}, whole.states.at(window));
    EXPECT_EQ(rest.told.size(), windows - window);
    for (const auto& [n, bytes] : rest.told) ASSERT_TRUE(bytes == whole.told.at(n)) << n << " from " << window;
  }
}

/// Coarse, and with friction on the sliding face.
scene::Impactor foam(scene::Impactor impactor) {
  impactor.mutable_slug()->set_half_width(0.05);
  impactor.mutable_slug()->set_height(0.1);
  impactor.mutable_foam()->set_friction(0.3);
  impactor.mutable_foam()->set_elements(12);
  impactor.mutable_foam()->set_shock_width(0.2);
  return impactor;
}

scene::Impactor pulse() {
  scene::Impactor impactor;
  impactor.set_type(scene::Impactor::TYPE_PRESSURE);
  scene::Pressure& pressure = *impactor.mutable_pressure();
  pressure.mutable_exponential()->set_peak(5e7);
  pressure.mutable_exponential()->set_decay_time(1e-5);
  return impactor;
}

TEST(ImpactorState, OfAFoamProjectile) {
  expect_the_same_bits(setup_of(foam(test::reference_foam()), scene::SYMMETRY_PLANE_STRAIN));
}

TEST(ImpactorState, OfACylinderOfFoam) {
  expect_the_same_bits(setup_of(foam(test::reference_cylinder()), scene::SYMMETRY_AXISYMMETRIC));
}

TEST(ImpactorState, OfAPressure) { expect_the_same_bits(setup_of(pulse(), scene::SYMMETRY_PLANE_STRAIN)); }

TEST(ImpactorState, OfAnotherModelIsRefused) {
  const wire::Setup setup = setup_of(foam(test::reference_foam()), scene::SYMMETRY_PLANE_STRAIN);
  const std::string state = play(setup, 0, {5}, std::nullopt).states.at(5);
  EXPECT_THROW(play(setup, 6, {}, state.substr(0, state.size() - 1)), std::range_error);
  EXPECT_THROW(play(setup, 6, {}, state + "x"), std::range_error);
  EXPECT_THROW(play(setup_of(pulse(), scene::SYMMETRY_PLANE_STRAIN), 6, {}, state), std::range_error);
  EXPECT_THROW(play(setup, 6, {}, std::nullopt), InputError) << "no state to go on with";
  EXPECT_THROW(play(setup, 0, {}, state), InputError) << "a state at the beginning";
}

}  // namespace
}  // namespace grainstep::fe
