/// The recorder, the summary and the rules about a failed run, with reports made by hand.
#include "orchestrator/record/recorder.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "orchestrator/record/summary.hpp"
#include "participant/schedule.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;

constexpr double force = -4.0;  // N on the only segment, along x2

scene::Scene scene_of_one_segment() {
  scene::Scene out;
  out.set_depth(0.001);
  out.mutable_time()->mutable_end()->set_seconds(0.4);
  scene::Slug& slug = *out.mutable_impactor()->mutable_slug();
  slug.set_half_width(0.5);
  slug.set_height(1.0);
  slug.set_relative_density(0.2);
  slug.set_speed(2.0);
  slug.mutable_particle()->set_density(1000.0);
  out.mutable_structure()->set_half_span(1.0);
  out.mutable_structure()->set_extent(scene::Structure::EXTENT_FULL);
  scene::Layer& layer = *out.mutable_structure()->add_layers();
  layer.set_material(scene::Layer::MATERIAL_DH36);
  layer.set_thickness(0.1);
  layer.set_density(1000.0);
  layer.set_yield_strength(1e9);
  out.mutable_impactor()->set_type(scene::Impactor::TYPE_SLUG);
  out.mutable_guards()->set_energy_drift(0.03);
  out.mutable_guards()->set_momentum_error(1e-9);
  out.mutable_guards()->set_overlap(0.5);
  out.mutable_guards()->set_element_quality(0.01);
  return out;
}

class RecorderTest : public ::testing::Test {
 protected:
  RecorderTest() {
    plan_.window = 0.01;
    plan_.windows = 40;
    plan_.report_every = 10;
    plan_.profile_every = 20;
    for (const double x : {-1.0, 0.0, 1.0, 0.0}) surface_.add_position(x);
    surface_.add_facet(0);
    surface_.add_facet(1);
    start_over();
  }

  void start_over() {
    recorder_.reset();
    file_.reset();
    static_cast<void>(directory_.prepare(results::Existing::replace));
    file_.emplace(directory_.results(), std::vector<results::Text>{});
    recorder_.emplace(Recorder::Context{.scene = scene_, .groups = groups_, .plan = plan_, .surface = surface_},
                      directory_, *file_, nullptr);
  }

  void window(std::uint64_t n) {
    wire::Forces forces;
    forces.set_window(n);
    const double impulse = n > load_until_ ? 0.0 : force * plan_.window * (n == 0 ? 0.5 : 1.0);
    for (int node = 0; node < 2; ++node) {
      forces.add_impulse(0.0);
      forces.add_impulse(0.5 * impulse);
    }
    recorder_->forces(forces);
    if (participant::due_at(plan_.start(), n).report) {
      recorder_->report(wire::STRUCTURE, report(n, 0.0, 1.0));
      recorder_->report(wire::IMPACTOR, report(n, -10.0, -1.0));
    }
  }

  // Momentum p0 plus (or minus) all of the impulse, everything else constant.
  [[nodiscard]] wire::Report report(std::uint64_t n, double p0, double sign) const {
    const double acting = n > load_until_ ? static_cast<double>(load_until_) + 0.5 : static_cast<double>(n);
    const double received = sign * force * plan_.window * acting;
    wire::Report out;
    out.set_window(n);
    for (const double value : {0.0, p0 + received}) out.mutable_momentum()->add_linear(value);
    for (const double value : {0.0, received}) out.mutable_momentum()->add_interface_impulse(value);
    out.mutable_energy()->set_kinetic(n == 30 ? broken_energy_ : 50.0);
    auto* peak = out.add_observable();
    peak->set_name("peak_deflection");
    peak->set_unit("m");
    peak->set_value(peak_);
    auto* deflection = out.add_observable();
    deflection->set_name("deflection");
    deflection->set_value(deflection_(static_cast<double>(n) * plan_.window));
    if (!cored_) return out;
    for (const auto& [name, value] : {std::pair{"peak_core_compression", 0.3}, {"peak_core_compression_time", 2.0}}) {
      auto* observable = out.add_observable();
      observable->set_name(name);
      observable->set_value(value);
    }
    return out;
  }

  [[nodiscard]] auto summary_so_far() const {
    return summary({.status = "done",
                    .reason = "",
                    .scene = scene_,
                    .groups = groups_,
                    .plan = plan_,
                    .findings = recorder_->findings(),
                    .impactor = {},
                    .structure = {},
                    .impactor_timing = {},
                    .structure_timing = {}});
  }

  scene::Scene scene_ = scene_of_one_segment();
  scene::Groups groups_ = scene::groups(scene_);
  StepPlan plan_;
  wire::Surface surface_;
  TemporaryDirectory scratch_;
  results::RunDirectory directory_{scratch_.path() / "run"};
  std::optional<results::ResultsFile> file_;
  std::optional<Recorder> recorder_;
  double broken_energy_ = 50.0;
  std::uint64_t load_until_ = 1000;                                        // window
  double peak_ = 0.25;                                                     // m
  std::function<double(double)> deflection_ = [](double) { return 0.0; };  // m, of time
  bool cored_ = false;
};

TEST_F(RecorderTest, AConstantForceIsAConstantPressureInRowsAndProfiles) {
  for (std::uint64_t n = 0; n <= plan_.windows; ++n) window(n);
  recorder_->finish();
  const auto file = results::h5::File::read(directory_.results());
  const double pressure = 4.0 / (2 * 0.5 * 0.001);  // over the slug's width
  const auto mean = file.read_doubles("/series/mean_pressure");
  ASSERT_EQ(mean.size(), 5U);
  EXPECT_EQ(mean[0], 0.0);
  for (std::size_t i = 1; i < mean.size(); ++i) EXPECT_NEAR(mean[i] / pressure, 1.0, 1e-12);
  for (const double p : file.read_doubles("/profiles/pressure")) {
    EXPECT_NEAR(p / (4.0 / (2.0 * 0.001)), 1.0, 1e-12);  // over the segment's length of 2 m
  }
  EXPECT_NEAR(recorder_->findings().transmitted / (pressure * 0.4), 1.0, 1e-12);
  EXPECT_LT(recorder_->findings().momentum_error, 1e-14);
}

TEST_F(RecorderTest, TheSummaryScalesWhatWasFound) {
  for (std::uint64_t n = 0; n <= plan_.windows; ++n) window(n);
  const auto s = summary_so_far();
  const double pressure = 4000.0;
  EXPECT_NEAR(s["early_pressure"].get<double>(), pressure / (200.0 * 2.0 * 2.0), 1e-9);
  EXPECT_NEAR(s["transmitted_impulse"].get<double>(), pressure * 0.4 / (200.0 * 1.0 * 2.0), 1e-9);
  EXPECT_NEAR(s["peak_deflection"].get<double>(), 0.25, 1e-15);
  EXPECT_TRUE(s["peak_core_compression"].is_null());
}

TEST_F(RecorderTest, ACoresCompressionIsInTheSummary) {
  cored_ = true;
  for (std::uint64_t n = 0; n <= 10; ++n) window(n);
  EXPECT_EQ(recorder_->findings().peak_core_compression, 0.3);
  const auto s = summary_so_far();
  EXPECT_DOUBLE_EQ(s["peak_core_compression"].get<double>(), 0.3);
  EXPECT_DOUBLE_EQ(s["peak_core_compression_time"].get<double>(), 2.0 / groups_.reference_time);
  EXPECT_NE(digest(s).find("core compression     0.300"), std::string::npos);
}

// Rows at every window, a load for the first 5 of 40, and a beam that is pulled and swings about -0.2 m.
TEST_F(RecorderTest, ThePermanentDeflectionIsInTheSummary) {
  plan_.report_every = 1;
  peak_ = -0.25;
  start_over();
  EXPECT_FALSE(recorder_->findings().rest) << "nothing has come yet";
  deflection_ = [](double t) { return -0.2 + 0.05 * std::cos(2.0 * std::numbers::pi * t / 0.12); };
  load_until_ = 5;
  for (std::uint64_t n = 0; n <= plan_.windows; ++n) window(n);
  const auto s = summary_so_far();
  EXPECT_DOUBLE_EQ(s["peak_deflection"].get<double>(), -0.25);
  EXPECT_NEAR(s["final_deflection"].get<double>(), -0.2, 0.05 * 0.02);
  EXPECT_NEAR(s["final_deflection_spread"].get<double>(), 0.05, 0.05 * 0.05);
  EXPECT_THAT(digest(s), HasSubstr("peak deflection      -0.2500 w/L"));
  EXPECT_THAT(digest(s), HasSubstr("final deflection     -0.20"));
}

TEST_F(RecorderTest, ASmallDeflectionIsNotPrintedAsNone) {
  peak_ = -8.9e-6;
  for (std::uint64_t n = 0; n <= 10; ++n) window(n);
  EXPECT_THAT(digest(summary_so_far()), HasSubstr("peak deflection      -8.9e-06 w/L"));
  peak_ = 0.0;
  for (std::uint64_t n = 11; n <= 20; ++n) window(n);
  EXPECT_THAT(digest(summary_so_far()), HasSubstr("peak deflection      0.0000 w/L"));
}

TEST_F(RecorderTest, UnderLoadThereIsNoPermanentDeflection) {
  plan_.report_every = 1;
  start_over();
  deflection_ = [](double t) { return 0.2 + 0.05 * std::cos(2.0 * std::numbers::pi * t / 0.12); };
  for (std::uint64_t n = 0; n <= plan_.windows; ++n) window(n);
  const auto s = summary_so_far();
  EXPECT_TRUE(s["final_deflection"].is_null());
  EXPECT_TRUE(s["final_deflection_spread"].is_null());
  EXPECT_EQ(digest(s).find("final deflection"), std::string::npos);
}

TEST_F(RecorderTest, WithoutAYieldStrengthTimesAreSeconds) {
  scene_.mutable_structure()->mutable_layers(0)->set_material(scene::Layer::MATERIAL_ELASTIC);
  groups_ = scene::groups(scene_);
  broken_energy_ = 60.0;
  std::string text;
  try {
    for (std::uint64_t n = 0; n <= plan_.windows; ++n) window(n);
  } catch (const NumericalError& error) {
    text = error.what();
  }
  EXPECT_THAT(text, HasSubstr("at window 30 of 40 (t 300.0000 ms)"));
  const auto s = summary_so_far();
  for (const char* key : {"impulse_number", "loading_time_ratio", "peak_deflection_time", "final_time"}) {
    EXPECT_TRUE(s[key].is_null()) << key;
  }
  EXPECT_DOUBLE_EQ(s["final_seconds"].get<double>(), 0.3);
  EXPECT_THAT(digest(s), HasSubstr("(run to 300 ms)"));
  recorder_->finish();
  EXPECT_FALSE(results::h5::File::read(directory_.results()).has("/series/t_bar"));
}

TEST_F(RecorderTest, AShortRunHasNoEarlyPressure) {
  for (std::uint64_t n = 0; n <= 10; ++n) window(n);  // t_hat = 0.2
  EXPECT_FALSE(recorder_->findings().early_impulse);
}

TEST_F(RecorderTest, ABrokenLimitEndsTheRunAfterItsRowIsKept) {
  broken_energy_ = 60.0;
  std::string text;
  try {
    for (std::uint64_t n = 0; n <= plan_.windows; ++n) window(n);
  } catch (const NumericalError& error) {
    text = error.what();
  }
  EXPECT_THAT(text, HasSubstr("at window 30 of 40"));
  EXPECT_THAT(text, HasSubstr("guards.energy_drift: found 0.2, allowed 0.03"));
  recorder_->finish();
  EXPECT_EQ(results::h5::File::read(directory_.results()).read_doubles("/series/time").size(), 4U);
}

}  // namespace
}  // namespace grainstep::orchestrator
