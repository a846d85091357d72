// Runs the same slug on all ranks of the MPI job together and on rank 0 alone, and compares. Started by dem_ranks_test.
#include <cstdio>
#include <cstring>
#include <memory>

#include "../unit/dem-service/slice_rig.hpp"
#include "base/error.hpp"
#include "dem-service/lammps/impactor.hpp"

namespace {

using namespace grainstep;
using namespace grainstep::dem;
using namespace grainstep::dem::rig;

constexpr std::uint64_t windows = 250;

wire::Setup half_slug() {
  wire::Setup setup = reference_setup();
  setup.set_mirror(true);
  set_flat_surface(setup, 0.2, 60);
  return setup;
}

wire::Setup slice_of_spheres() {
  wire::Setup setup = slice_setup();
  set_rings(setup, 0.2, 60);
  return setup;
}

/// The surface gives way and tilts, so that particles migrate and springs turn.
Motion yielding() {
  return [](std::uint64_t n, const Vec2& x) {
    const double t = static_cast<double>(n) / static_cast<double>(windows);
    return x + Vec2{{0.0, -t * t * (2e-3 - 0.02 * x[0])}};
  };
}

std::unique_ptr<ScriptedLink> run_on(MPI_Comm communicator, const wire::Setup& setup) {
  wire::Start start = start_of(model_of(setup).preferred_step, windows, 2);
  start.set_report_every(50);
  auto link = std::make_unique<ScriptedLink>(setup, start, yielding());
  const auto impactor = make_impactor({.communicator = communicator, .lammps_log = {}});
  (void)impactor->prepare(setup);
  impactor->run(start, *link);
  return link;
}

int failures = 0;

void expect_close(const char* what, std::uint64_t window, double one, double many, double scale, double tolerance) {
  if (std::abs(one - many) <= tolerance * scale) return;
  std::printf("window %llu: %s differs, %.17g on one rank, %.17g on many (allowed: %g of %g)\n",
              static_cast<unsigned long long>(window), what, one, many, tolerance, scale);
  ++failures;
}

void compare(const ScriptedLink& one, const ScriptedLink& many) {
  // Round-off grows with every collision (dem_wall_gran_test.cpp): 500 steps.
  constexpr double grown_round_off = 1e-8;
  constexpr double round_off = 1e-12;
  const double energy = one.reports.front().energy().kinetic();
  const double momentum = std::abs(one.reports.front().momentum().linear(1));
  for (std::size_t i = 0; i < one.reports.size(); ++i) {
    const wire::Report& a = one.reports[i];
    const wire::Report& b = many.reports[i];
    const auto n = a.window();
    expect_close("kinetic", n, a.energy().kinetic(), b.energy().kinetic(), energy, grown_round_off);
    expect_close("elastic", n, a.energy().elastic(), b.energy().elastic(), energy, grown_round_off);
    expect_close("damping", n, a.energy().damping(), b.energy().damping(), energy, grown_round_off);
    expect_close("friction", n, a.energy().friction(), b.energy().friction(), energy, grown_round_off);
    expect_close("interface_work", n, a.energy().interface_work(), b.energy().interface_work(), energy,
                 grown_round_off);
    for (int c = 0; c < 2; ++c) {
      const double closed = b.momentum().linear(c) - many.reports.front().momentum().linear(c) -
                            b.momentum().interface_impulse(c) - b.momentum().support_impulse(c);
      expect_close("momentum closure", n, 0.0, closed, momentum, round_off);
    }
  }
  const wire::Snapshot& a = one.snapshots.back();
  const wire::Snapshot& b = many.snapshots.back();
  if (a.position_size() != b.position_size()) ++failures;
  for (int i = 0; i < std::min(a.position_size(), b.position_size()); ++i) {
    expect_close("position", windows, a.position(i), b.position(i), 1e-3, grown_round_off);
  }
}

/// A particle that tunnels on whatever rank it lives: rank 0 must say so and nobody may hang.
bool tunnelling_is_reported() {
  wire::Setup setup = half_slug();
  slug_of(setup).set_speed(5000.0);
  try {
    (void)run_on(MPI_COMM_WORLD, setup);
  } catch (const NumericalError&) {
    return true;
  }
  return false;
}

}  // namespace

int main() {
  start_mpi();
  int rank = 0;
  int ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const EngineOptions together{.communicator = MPI_COMM_WORLD, .lammps_log = {}};
  if (rank == 0) {
    for (const wire::Setup& setup : {half_slug(), slice_of_spheres()}) {
      const auto many = run_on(MPI_COMM_WORLD, setup);
      const auto one = run_on(MPI_COMM_SELF, setup);
      compare(*one, *many);
    }
    if (!tunnelling_is_reported()) {
      std::printf("tunnelling was not reported\n");
      ++failures;
    }
    std::printf("%d ranks, %d differences\n", ranks, failures);
  } else {
    for (int run = 0; run < 3; ++run) follow(together);
  }
  MPI_Finalize();
  return failures == 0 && ranks > 1 ? 0 : 1;
}
