// Contacts between particles without LAMMPS: every copy of the kernel gives the same bits, energy is exact.
#include "dem-service/pair/contacts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>

namespace grainstep::dem {
namespace {

constexpr PairLaw law{7.3e6, 2.0 / 7.0 * 7.3e6, 5.9e5, 0.7};
constexpr double dt = 1.2e-7;

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

struct Result {
  PairBatch batch{};
  PairSums sums;
  std::array<std::array<double, batch_capacity>, most_history_values> history{};
};

/// For the effective masses of 1e-7 kg to 3e-6 kg below; its values do not matter, so long as they vary.
contact::DampingTable damping() {
  contact::DampingTable table{.scale = dt * std::sqrt(law.normal_stiffness), .first = 0.1, .per_spacing = 100.0};
  for (int i = 0; i <= contact::DampingTable::nodes; ++i) table.value[i] = (4.0 - 0.01 * i * i) / dt;
  return table;
}

void evaluate(const PairKernels& kernels, const PairFeatures& features, Result& result) {
  std::mt19937_64 random(3);
  result.batch.count = batch_capacity;
  for (int l = 0; l < batch_capacity; ++l) {
    for (int c = 0; c < 3; ++c) {
      result.batch.branch[c][l] = uniform(random, -0.6e-3, 0.6e-3);
      result.batch.velocity[c][l] = uniform(random, -100.0, 100.0);
      result.batch.rolling[c][l] = uniform(random, -100.0, 100.0);
    }
    result.batch.reach[l] = 1.1e-3;
    result.batch.effective_mass[l] = uniform(random, 0.2e-6, 2.5e-6);
    for (auto& value : result.history) value[static_cast<std::size_t>(l)] = uniform(random, -1e-6, 1e-6);
  }
  double* history[most_history_values];
  for (std::size_t h = 0; h < most_history_values; ++h) history[h] = result.history[h].data();
  static const contact::DampingTable table = damping();
  PairLaw of_masses = law;
  of_masses.damping_table = &table;
  kernels.of(features)(of_masses, dt, result.batch, history, result.sums);
}

TEST(PairKernels, AllCopiesGiveTheSameBits) {
  for (const int dimension : {2, 3}) {
    for (const int kind : {0, 1, 2, 3}) {
      Result first;
      Result other;
      const PairFeatures features{.dimension = dimension, .friction = kind % 2 == 0, .mixed = kind / 2 == 1};
      evaluate(*available_pair_kernels().front(), features, first);
      EXPECT_GT(first.sums.stored_normal[0], 0.0);
      for (const PairKernels* kernels : available_pair_kernels()) {
        other.sums = {};
        evaluate(*kernels, features, other);
        // Bits are meant: zeros of another sign are a difference.
        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
        EXPECT_EQ(std::memcmp(&first.batch.force, &other.batch.force, sizeof first.batch.force), 0) << kernels->name;
        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
        EXPECT_EQ(std::memcmp(&first.sums, &other.sums, sizeof first.sums), 0) << kernels->name;
        EXPECT_EQ(first.history, other.history) << kernels->name;
      }
    }
  }
}

/// Two discs that meet off centre, spinning, moved by velocity Verlet.
struct Collision2 {
  double x[6], v[6], spin[6] = {}, force[6] = {}, torque[6] = {};
  double radius[2] = {0.5e-3, 0.4e-3};
  double mass[2] = {2.1e-6, 1.5e-6};

  [[nodiscard]] double inertia(int i) const { return 0.5 * mass[i] * radius[i] * radius[i]; }
  [[nodiscard]] double kinetic() const {
    double sum = 0.0;
    for (int i = 0; i < 2; ++i) {
      const double* u = v + std::ptrdiff_t{3} * i;
      sum += 0.5 * mass[i] * (u[0] * u[0] + u[1] * u[1]);
      sum += 0.5 * inertia(i) * spin[3 * i + 2] * spin[3 * i + 2];
    }
    return sum;
  }
  void kick(double step) {
    for (int k = 0; k < 6; ++k) {
      v[k] += step * force[k] / mass[k / 3];
      spin[k] += step * torque[k] / inertia(k / 3);
    }
  }
  void evaluate(PairContacts& contacts, double grown) {
    std::fill_n(force, 6, 0.0);
    std::fill_n(torque, 6, 0.0);
    contacts.evaluate({x, v, spin, force, torque, radius, mass}, grown);
  }
};

/// What is missing of the energy after the collision, over what was lost.
double unaccounted(double step, double friction) {
  PairLaw rubbing = law;
  rubbing.friction = friction;
  PairContacts contacts(rubbing, {.dimension = 2, .friction = friction > 0.0});
  contacts.clear(0.5e-3);
  contacts.add(0, 1);
  Collision2 pair{{0.0, 0.0, 0.0, 0.9001e-3, 0.3e-3, 0.0}, {100.0, 0.0, 0.0, -100.0, 0.0, 0.0}};
  pair.spin[2] = 2e4;
  const double before = pair.kinetic();
  pair.evaluate(contacts, 0.0);
  for (double t = 0.0; t < 2e-5; t += step) {
    pair.kick(0.5 * step);
    for (int k = 0; k < 6; ++k) pair.x[k] += step * pair.v[k];
    pair.evaluate(contacts, step);
    pair.kick(0.5 * step);
  }
  const PairEnergy energy = contacts.energy();
  const double lost = before - pair.kinetic();
  EXPECT_EQ(contacts.count(), 0U);
  EXPECT_EQ(energy.stored_normal, 0.0);
  EXPECT_EQ(energy.stored_tangential, 0.0);
  EXPECT_GT(energy.damping, 0.0);
  EXPECT_EQ(energy.tangential != 0.0, friction > 0.0);
  EXPECT_GT(lost, 0.05 * before);
  return std::abs(lost - energy.damping - energy.tangential) / lost;
}

TEST(PairContacts, WhatACollisionLosesIsDissipated) {
  // The springs that begin and end between two steps are all that is missing: of second order.
  for (const double friction : {0.0, 0.7}) {
    EXPECT_LT(unaccounted(dt, friction), 0.05);
    EXPECT_LT(unaccounted(dt / 100.0, friction), 5e-6);
  }
}

}  // namespace
}  // namespace grainstep::dem
