// Speed of the FE element loop: triangle updates per second and core, elastic and with DH36 flowing, on the beam's
// meshes of h/8 and h/15, for every instruction set of this machine; and the time that the stable step takes.
#include <benchmark/benchmark.h>

#include <string>

#include "fe-service/body.hpp"

namespace {

using grainstep::fe::available_kernels;
using grainstep::fe::Body;
using grainstep::fe::Kernels;
using grainstep::fe::Nodes;

constexpr double kStep = 1e-7;  // s

enum class Flow { none, dh36, core };

struct Case {
  int refinement;
  Flow flow;

  [[nodiscard]] std::string name() const {
    const char* const flows[] = {"elastic", "dh36", "core"};
    return std::string(flows[static_cast<int>(flow)]) + "/h_" + std::to_string(refinement);
  }
};

Body make_body(const Case& setting, const Kernels& kernels) {
  grainstep::scene::Structure structure;
  structure.set_half_span(0.5);
  structure.mutable_mesh()->set_refinement(setting.refinement);
  structure.add_layers()->set_thickness(0.05);
  const auto elastic = grainstep::fe::Elastic::from_young(200e9, 0.3, 8000.0);
  const grainstep::fe::Dh36 steel{elastic, 470e6, 1.5, 0.4, 0.015, 1.0};
  // Of a tenth of the steel's density and strength, with the viscosity of (3.10) for c/L = 0.33.
  const grainstep::fe::Core core{grainstep::fe::Elastic::from_young(20e9, 0.25, 800.0), 5e6, 1.9, 20e9, 6.3e3, 5e6};
  const bool is_core = setting.flow == Flow::core;
  return {grainstep::fe::make_mesh(structure),
          {is_core ? grainstep::fe::Material(core) : steel},
          grainstep::fe::PlaneStrain{1e-3},
          kernels};
}

/// Bending about the middle of the thickness at a rate that varies along the span: all but a middle strip flows, at
/// plastic strain rates of up to 800 1/s, as in the reference event. The other case strains a hundred thousand times
/// slower.
void prescribe(Body& body, double rate, double direction) {
  for (Nodes* nodes : {&body.corners, &body.centres}) {
    for (std::size_t i = 0; i < nodes->x.size(); ++i) {
      const double x = nodes->x0[i];
      const double y = nodes->y0[i] + 0.025;
      const double curvature = direction * rate * (1.0 - 1.2 * x) / 0.025;
      nodes->u[i] = -curvature * x * y;
      nodes->v[i] = 0.5 * curvature * x * x;
    }
  }
}

void element_updates(benchmark::State& state, const Case& setting, const Kernels& kernels) {
  Body body = make_body(setting, kernels);
  const double rate = setting.flow == Flow::none ? 8e-3 : 800.0;
  prescribe(body, rate, 1.0);
  std::uint64_t steps = 0;
  double direction = 1.0;
  for (auto _ : state) {
    if (++steps % 1000 == 0) {  // strain stays within 8%
      state.PauseTiming();
      direction = -direction;
      prescribe(body, rate, direction);
      state.ResumeTiming();
    }
    body.drift(kStep);
    benchmark::DoNotOptimize(body.sweep(kStep));
  }
  std::uint64_t flowed = 0;
  for (int row = 0; row < body.mesh().row_count(); ++row) {
    for (int column = 0; column < body.mesh().columns; ++column) {
      for (int t = 0; t < 4; ++t) flowed += body.plastic_strain(row, column, t) > 0.0 ? 1 : 0;
    }
  }
  state.counters["triangles"] = static_cast<double>(body.mesh().triangles());
  state.counters["flowed"] = static_cast<double>(flowed) / static_cast<double>(body.mesh().triangles());
  state.counters["updates"] =
      benchmark::Counter(static_cast<double>(body.mesh().triangles() * steps), benchmark::Counter::kIsRate);
}

void stable_step(benchmark::State& state, const Case& setting, const Kernels& kernels) {
  const Body body = make_body(setting, kernels);
  for (auto _ : state) benchmark::DoNotOptimize(body.stable_step());
}

}  // namespace

int main(int argc, char** argv) {
  for (const Kernels* kernels : available_kernels()) {
    for (const Case setting :
         {Case{8, Flow::none}, Case{8, Flow::dh36}, Case{8, Flow::core}, Case{15, Flow::none}, Case{15, Flow::dh36}}) {
      const std::string name = std::string(kernels->name) + "/" + setting.name();
      benchmark::RegisterBenchmark(name.c_str(), element_updates, setting, *kernels)->Unit(benchmark::kMicrosecond);
    }
    const std::string name = std::string(kernels->name) + "/stable_step/h_8";
    benchmark::RegisterBenchmark(name.c_str(), stable_step, Case{8, Flow::none}, *kernels)
        ->Unit(benchmark::kMicrosecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
