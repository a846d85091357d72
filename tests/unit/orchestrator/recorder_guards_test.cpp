// That a run asks every guard of its scene: reports made by hand, each with one thing wrong.
#include <gmock/gmock.h>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "orchestrator/record/recorder.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

scene::Scene scene_with_guards() {
  scene::Scene out;
  out.set_depth(0.001);
  out.mutable_time()->mutable_end()->set_seconds(0.02);
  out.mutable_structure()->set_half_span(1.0);
  scene::Layer& layer = *out.mutable_structure()->add_layers();
  layer.set_thickness(0.1);
  layer.set_density(1000.0);
  layer.set_yield_strength(1e9);
  scene::Slug& slug = *out.mutable_impactor()->mutable_slug();
  slug.set_half_width(0.5);
  slug.set_height(1.0);
  slug.set_relative_density(0.2);
  slug.set_speed(2.0);
  slug.mutable_particle()->set_density(1000.0);
  out.mutable_guards()->set_energy_drift(0.03);
  out.mutable_guards()->set_momentum_error(1e-9);
  out.mutable_guards()->set_overlap(0.5);
  out.mutable_guards()->set_element_quality(0.01);
  return out;
}

/// Two windows without any force; `impactor` and `structure` are the reports at the end of the first.
class GuardedRun {
 public:
  GuardedRun() {
    plan_.window = 0.01;
    plan_.windows = 2;
    for (const double x : {0.0, 0.0, 1.0, 0.0}) surface_.add_position(x);
    surface_.add_facet(0);
    surface_.add_facet(1);
    static_cast<void>(directory_.prepare(results::Existing::refuse));
    file_.emplace(directory_.results(), std::vector<results::Text>{});
    recorder_.emplace(Recorder::Context{.scene = scene_, .groups = groups_, .plan = plan_, .surface = surface_},
                      directory_, *file_, nullptr);
  }

  static wire::Report report(std::uint64_t window) {
    wire::Report out;
    out.set_window(window);
    for (const double p : {0.0, -1.0}) out.mutable_momentum()->add_linear(p);
    for (int c = 0; c < 2; ++c) out.mutable_momentum()->add_interface_impulse(0.0);
    for (int c = 0; c < 2; ++c) out.mutable_momentum()->add_support_impulse(0.0);
    out.mutable_energy()->set_kinetic(1.0);
    return out;
  }

  static void observe(wire::Report& report, const char* name, double value) {
    wire::Observable& added = *report.add_observable();
    added.set_name(name);
    added.set_value(value);
  }

  /// Why the run ended; empty when it did not.
  std::string end() {
    try {
      hear(0, report(0), report(0));
      hear(1, impactor_, structure_);
    } catch (const NumericalError& error) {
      return error.what();
    }
    return "";
  }

  wire::Report impactor_ = report(1);
  wire::Report structure_ = report(1);

 private:
  void hear(std::uint64_t window, const wire::Report& impactor, const wire::Report& structure) {
    wire::Forces forces;
    forces.set_window(window);
    for (int i = 0; i < 4; ++i) forces.add_impulse(0.0);
    recorder_->forces(forces);
    recorder_->report(wire::IMPACTOR, impactor);
    recorder_->report(wire::STRUCTURE, structure);
  }

  scene::Scene scene_ = scene_with_guards();
  scene::Groups groups_ = scene::groups(scene_);
  StepPlan plan_;
  wire::Surface surface_;
  TemporaryDirectory scratch_;
  results::RunDirectory directory_{scratch_.path() / "run"};
  std::optional<results::ResultsFile> file_;
  std::optional<Recorder> recorder_;
};

TEST(GuardedRun, GoesOnWhereNothingIsWrong) {
  GuardedRun run;
  GuardedRun::observe(run.impactor_, "max_overlap", 0.4);
  GuardedRun::observe(run.structure_, "min_element_quality", 0.02);
  EXPECT_THAT(run.end(), IsEmpty());
}

TEST(GuardedRun, EndsWhereParticlesOverlapTooMuch) {
  GuardedRun run;
  GuardedRun::observe(run.impactor_, "max_overlap", 0.6);
  EXPECT_THAT(run.end(), HasSubstr("guards.overlap: found 0.6, allowed 0.5"));
}

TEST(GuardedRun, EndsWhereAnElementCollapses) {
  GuardedRun run;
  GuardedRun::observe(run.structure_, "min_element_quality", 0.001);
  EXPECT_THAT(run.end(), HasSubstr("guards.element_quality: found 0.001, allowed 0.01"));
}

TEST(GuardedRun, EndsWhereMomentumIsLost) {
  GuardedRun run;
  run.structure_.mutable_momentum()->set_linear(1, -0.5);
  EXPECT_THAT(run.end(), HasSubstr("guards.momentum_error: found"));
}

TEST(GuardedRun, EndsWhereEnergyIsMade) {
  GuardedRun run;
  run.impactor_.mutable_energy()->set_elastic(0.5);
  EXPECT_THAT(run.end(), HasSubstr("at window 1 of 2"));
}

}  // namespace
}  // namespace grainstep::orchestrator
