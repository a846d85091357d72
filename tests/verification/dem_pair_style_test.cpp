// Our pair style is LAMMPS's own `gran/hooke/history` (without friction: `gran/hooke`), bit for bit: a cloud of
// particles of different sizes falls together in two LAMMPS instances that differ in the pair style alone. Collisions
// multiply a difference by ten in about every eighty steps, so nothing but identical bits stays small.
#include <gtest/gtest.h>

#define LAMMPS_LIB_MPI
#include <lammps/library.h>

#include <array>
#include <cstdio>
#include <random>
#include <vector>

#include "../unit/dem-service/engine_rig.hpp"
#include "dem-service/lammps/pair_style.hpp"

namespace grainstep::dem {
namespace {

constexpr int steps = 1200;
constexpr int compared_every = 100;

struct Cloud {
  int dimension = 2;
  double friction = 0.7;
  int particles = 400;
};

/// The law of the reference particles, D = 1 mm; in 3D spheres of that diameter.
constexpr double diameter = 1e-3;
constexpr double stiffness = 7.3e6;
constexpr double damping = 5.9e5;
constexpr double spacing = 1.5 * diameter;

class CloudInLammps {
 public:
  CloudInLammps(const Cloud& cloud, const std::string& pair_style) : session_(rig::alone().communicator, {}) {
    const bool flat = cloud.dimension == 2;
    for (const char* line : {"units si", "atom_style sphere", flat ? "dimension 2" : "dimension 3", "newton on",
                             flat ? "boundary s s p" : "boundary s s s", "comm_modify vel yes"}) {
      session_.command(line);
    }
    session_.command(flat ? "region cloud block -0.02 0.02 -0.02 0.02 -0.001 0.001"
                          : "region cloud block -0.01 0.01 -0.01 0.01 -0.01 0.01");
    session_.command("create_box 1 cloud");
    PairStyle::register_style(session_.lammps());
    create(cloud);
    session_.command("pair_style " + pair_style);
    for (const char* line : {"pair_coeff * *", "neighbor 0.5e-3 bin", "neigh_modify delay 0 every 1 check yes",
                             flat ? "fix motion all nve/sphere disc" : "fix motion all nve/sphere", "timestep 1.2e-7",
                             "thermo_modify lost ignore", "run 0 post no"}) {
      session_.command(line);
    }
  }

  /// In runs of several lengths, each with its own setup: history must outlive them.
  void run(int n) { session_.command("run " + std::to_string(n) + " post no"); }

  [[nodiscard]] std::vector<std::array<double, 9>> motion() {
    const int count = *static_cast<int*>(lammps_extract_global(session_.handle(), "nlocal"));
    const auto* id = static_cast<int*>(lammps_extract_atom(session_.handle(), "id"));
    std::vector<std::array<double, 9>> all(static_cast<std::size_t>(count));
    std::size_t place = 0;
    for (const char* name : {"x", "v", "omega"}) {
      auto** rows = static_cast<double**>(lammps_extract_atom(session_.handle(), name));
      for (int i = 0; i < count; ++i) std::copy_n(rows[i], 3, &all[static_cast<std::size_t>(id[i] - 1)][place]);
      place += 3;
    }
    return all;
  }

  [[nodiscard]] LAMMPS_NS::LAMMPS& lammps() { return session_.lammps(); }

 private:
  void create(const Cloud& cloud) {
    std::mt19937_64 random(7);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    // On a disturbed lattice, without overlap, flying to the middle.
    const int row = cloud.dimension == 2 ? 20 : 7;
    const double reach = 0.5 * spacing * row;
    std::vector<int> id;
    std::vector<double> x;
    std::vector<double> v;
    for (int i = 0; i < cloud.particles; ++i) {
      id.push_back(i + 1);
      const std::array<int, 3> at{i % row, i / row % row, i / (row * row)};
      for (std::size_t c = 0; c < 3; ++c) {
        const bool moves = static_cast<int>(c) < cloud.dimension;
        const double place = moves ? spacing * (at[c] + 0.5) - reach + uniform(-0.2, 0.2) * diameter : 0.0;
        x.push_back(place);
        v.push_back(moves ? -150.0 * place / reach + uniform(-20.0, 20.0) : 0.0);
      }
    }
    const std::vector<int> type(id.size(), 1);
    lammps_create_atoms(session_.handle(), cloud.particles, id.data(), type.data(), x.data(), v.data(), nullptr, 0);
    auto* radius = static_cast<double*>(lammps_extract_atom(session_.handle(), "radius"));
    auto* mass = static_cast<double*>(lammps_extract_atom(session_.handle(), "rmass"));
    for (int i = 0; i < cloud.particles; ++i) {
      radius[i] = uniform(0.3, 0.5) * diameter;
      mass[i] = 2.12e-6 * 4.0 * radius[i] * radius[i] / (diameter * diameter);
    }
  }

  LammpsSession session_;
};

std::string text_of(const char* format, double friction) {
  char text[200];
  std::snprintf(text, sizeof text, format, stiffness, 2.0 / 7.0 * stiffness, damping, friction);
  return text;
}

void expect_same_bits(const Cloud& cloud) {
  const bool rubs = cloud.friction > 0.0;
  CloudInLammps ours(cloud, text_of("grainstep/hooke %.17g %.17g %.17g %.17g", cloud.friction));
  CloudInLammps theirs(
      cloud, text_of(rubs ? "gran/hooke/history %.17g %.17g %.17g 0 %.17g 0" : "gran/hooke %.17g %.17g %.17g 0 %.17g 0",
                     cloud.friction));
  const auto start = ours.motion();
  for (int n = 0; n < steps; n += compared_every) {
    ours.run(compared_every);
    theirs.run(compared_every);
    const auto a = ours.motion();
    const auto b = theirs.motion();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i], b[i]) << "particle " << i + 1 << " after step " << n;
  }
  EXPECT_NE(ours.motion(), start);
  const PairEnergy energy = lammps::find_pair<PairStyle>(ours.lammps()).energy();
  EXPECT_GT(energy.damping, 0.0);
  EXPECT_EQ(energy.tangential > 0.0, rubs);
}

TEST(DemPairStyle, DiscsLikeGranHookeHistory) { expect_same_bits({}); }
TEST(DemPairStyle, DiscsWithoutFrictionLikeGranHooke) { expect_same_bits({.friction = 0.0}); }
TEST(DemPairStyle, SpheresLikeGranHookeHistory) { expect_same_bits({.dimension = 3, .particles = 343}); }
TEST(DemPairStyle, SpheresWithoutFrictionLikeGranHooke) {
  expect_same_bits({.dimension = 3, .friction = 0.0, .particles = 343});
}

}  // namespace
}  // namespace grainstep::dem
