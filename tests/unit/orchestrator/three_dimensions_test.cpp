/// A run in three dimensions from the handshake to the files: nothing between two participants assumes a plane.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/temporary_directory.hpp"
#include "declare/write.hpp"
#include "fake_solids.hpp"
#include "orchestrator/command/conduct.hpp"
#include "participant/serve.hpp"
#include "patience.hpp"
#include "results/hdf5.hpp"
#include "scene/load.hpp"
#include "transport/in_process_channel.hpp"

namespace grainstep::orchestrator {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Lt;

class ThreeDimensions : public ::testing::Test {
 protected:
  static constexpr double longest = grainstep::testing::patience_s;

  void SetUp() override {
    scene::Scene& scene = preparation_.scene;
    scene.set_symmetry(scene::SYMMETRY_NONE);
    scene.mutable_impactor()->set_type(scene::Impactor::TYPE_EXTERNAL);
    scene.mutable_structure()->set_type(scene::Structure::TYPE_EXTERNAL);
    scene.mutable_time()->mutable_end()->set_seconds(0.04);
    scene.mutable_output()->set_rows(40);
    scene.mutable_output()->set_profiles(4);
    scene.mutable_output()->set_snapshots(5);
    scene.mutable_guards()->set_energy_drift(0.01);
    scene.mutable_guards()->set_momentum_error(1e-12);
    scene.mutable_guards()->set_overlap(0.5);
    preparation_.groups = scene::groups(scene);
    preparation_.yaml = declare::to_yaml(scene);
    const results::DirectoryLock lock = directory_.prepare(results::Existing::refuse);
    auto [impactor, impactor_far] = transport::make_in_process_pair({.first = "orchestrator", .second = "impactor"});
    auto [structure, structure_far] = transport::make_in_process_pair({.first = "orchestrator", .second = "structure"});
    std::ostringstream of_impactor;
    std::ostringstream of_structure;
    std::thread sphere([far = std::move(impactor_far), &of_impactor] {
      fake::ThrownSphere backend;
      static_cast<void>(participant::serve_impactor(*far, backend, {.errors = &of_impactor}));
    });
    std::thread plate([far = std::move(structure_far), &of_structure] {
      fake::FreePlate backend;
      static_cast<void>(participant::serve_structure(*far, backend, {.errors = &of_structure}));
    });
    EventLoop loop;
    Hub hub(*impactor, *structure, loop);
    ending_ = conduct(hub, {.preparation = preparation_,
                            .directory = directory_,
                            .deadlines = {.connect_s = longest, .step_s = longest, .stop_s = longest},
                            .account_of = {}});
    sphere.join();
    plate.join();
  }

  [[nodiscard]] std::vector<double> read(const std::string& dataset) const {
    return results::h5::File::read(directory_.results()).read_doubles(dataset);
  }
  [[nodiscard]] std::string paraview(const std::string& file) const {
    std::ostringstream out;
    out << std::ifstream(directory_.paraview() / file, std::ios::binary).rdbuf();
    return out.str();
  }

  TemporaryDirectory scratch_;
  results::RunDirectory directory_{scratch_.path() / "run"};
  Preparation preparation_;
  Ending ending_;
};

TEST_F(ThreeDimensions, GoThroughLedgersRowsProfilesAndSnapshots) {
  ASSERT_EQ(ending_.code, ExitCode::done) << ending_.reason;

  // Without friction it rebounds along x2 alone: by its momentum the elastic collision of two masses (closed form).
  constexpr double m = fake::ThrownSphere::mass;
  constexpr double plate = fake::FreePlate::mass;
  const double given = -2.0 * m * plate / (m + plate) * fake::ThrownSphere::velocity[1];
  EXPECT_NEAR(read("/ledger/impactor/momentum/interface_x2").back(), given, 2e-3 * given);
  EXPECT_NEAR(read("/ledger/structure/momentum/change_x2").back(), -given, 2e-3 * given);
  EXPECT_THAT(read("/ledger/structure/momentum/change_x3"), Each(0.0));
  EXPECT_THAT(read("/ledger/in_flight_x3"), Each(0.0));
  EXPECT_THAT(read("/ledger/momentum_error"), Each(Lt(1e-14)));
  EXPECT_THAT(read("/ledger/energy_drift"), Each(Lt(1e-2)));

  // Of the loaded face, whose area nobody said: I_t = impulse over 1 m^2. Profiles: one value a triangle, whose areas
  // times pressures and intervals add up to the impulse.
  EXPECT_NEAR(read("/series/transmitted_impulse").back(), given, 2e-3 * given);
  EXPECT_THAT(read("/profiles/area"), ::testing::ElementsAre(0.5, 0.5));
  EXPECT_EQ(read("/profiles/position").size(), 6U);
  const std::vector<double> pressure = read("/profiles/pressure");
  const std::vector<double> from = read("/profiles/from");
  const std::vector<double> to = read("/profiles/to");
  double sum = 0.0;
  for (std::size_t i = 0; i < pressure.size(); ++i) sum += 0.5 * pressure[i] * (to[i / 2] - from[i / 2]);
  EXPECT_NEAR(sum, read("/series/transmitted_impulse").back(), 1e-12);

  EXPECT_EQ(read("/snapshots/structure/0004/position").size(), 12U);
  EXPECT_EQ(read("/snapshots/particles/0004/position").size(), 3U);
  EXPECT_THAT(paraview("structure_0004.vtu"), HasSubstr("NumberOfPoints=\"4\" NumberOfCells=\"2\""));
  EXPECT_THAT(paraview("particles_0004.vtp"), HasSubstr("NumberOfPoints=\"1\" NumberOfVerts=\"1\""));
}

TEST_F(ThreeDimensions, WhatTheSceneHasNotIsNull) {
  std::ifstream in(directory_.summary());
  const nlohmann::json summary = nlohmann::json::parse(in);
  EXPECT_EQ(summary["status"], "done");
  for (const char* key : {"impulse_number", "areal_mass_ratio", "peak_deflection", "final_time", "early_pressure"}) {
    EXPECT_TRUE(summary[key].is_null()) << key << ": " << summary[key];
  }
  EXPECT_EQ(summary["particles"], 1);
  EXPECT_EQ(summary["ledgers"]["impactor"], "full");
}

}  // namespace
}  // namespace grainstep::orchestrator
