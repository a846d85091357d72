// Grains of several blocks, and several threads: results are those of one thread, and forces between blocks are there
// on both sides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "contact/moving_surface.hpp"
#include "dem-service/native/contacts.hpp"
#include "engine_rig.hpp"
#include "slice_rig.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

/// Grains of some blocks, until all of them have arrived.
wire::Setup discs(double width) {
  wire::Setup setup = reference_setup();
  set_flat_surface(setup, 0.1, 40);
  slug_of(setup).mutable_particle()->set_diameter(0.3e-3);
  if (width > 0.0) {
    auto& sizes = *slug_of(setup).mutable_size_distribution();
    sizes.set_by(scene::SizeDistribution::BY_NUMBER);
    sizes.mutable_uniform()->set_width(width);
  }
  return setup;
}

wire::Setup spheres() {
  wire::Setup setup = slice_setup();
  set_rings(setup, 0.1, 40);
  slug_of(setup).mutable_particle()->set_diameter(slug_of(setup).particle().diameter() / 2.0);
  return setup;
}

ScriptedLink run_with(int threads, const wire::Setup& setup) {
  const SlugModel model = model_of(setup);
  const scene::Slug& slug = slug_of(const_cast<wire::Setup&>(setup));
  const double duration = 1.1 * slug.height() / slug.speed();
  wire::Start start = start_of(model.preferred_step, static_cast<std::uint64_t>(duration / model.preferred_step));
  start.set_report_every(100);
  ScriptedLink link(setup, start, at_rest());
  auto particles = lay_out(model, contact::MovingSurface(setup.impactor().surface()).now());
  EXPECT_GT(particles.size(), 4096U) << "fewer than three blocks";
  native::make_engine(model, setup.impactor(), std::move(particles), threads)->run(start, link);
  return link;
}

template <typename Message>
std::string bytes_of(const std::vector<Message>& messages) {
  std::string bytes;
  for (const Message& message : messages) {
    if constexpr (requires(Message & timed) { timed.clear_timing(); }) {
      Message untimed = message;
      untimed.clear_timing();
      untimed.AppendToString(&bytes);
    } else {
      message.AppendToString(&bytes);
    }
  }
  return bytes;
}

void expect_the_same_with_any_number_of_threads(const wire::Setup& setup) {
  const ScriptedLink alone = run_with(1, setup);
  ASSERT_GT(alone.reports.back().energy().kinetic(), 0.0);
  for (const int threads : {2, 3, 5}) {
    const ScriptedLink together = run_with(threads, setup);
    EXPECT_EQ(bytes_of(together.forces), bytes_of(alone.forces)) << threads << " threads";
    EXPECT_EQ(bytes_of(together.reports), bytes_of(alone.reports)) << threads << " threads";
    EXPECT_EQ(bytes_of(together.snapshots), bytes_of(alone.snapshots)) << threads << " threads";
  }
}

TEST(NativeBlocks, DiscsAreTheSameWithAnyNumberOfThreads) { expect_the_same_with_any_number_of_threads(discs(0.0)); }

TEST(NativeBlocks, UnequalDiscsAreTheSameWithAnyNumberOfThreads) {
  expect_the_same_with_any_number_of_threads(discs(0.5));
}

TEST(NativeBlocks, SpheresAreTheSameWithAnyNumberOfThreads) { expect_the_same_with_any_number_of_threads(spheres()); }

// What one grain gets from another of a different block, that one gets as well: momentum is what came in less what the
// surface took, and turning is neither made nor lost by it.
TEST(NativeBlocks, ForcesBetweenBlocksActOnBoth) {
  const wire::Setup setup = discs(0.0);
  const ScriptedLink link = run_with(2, setup);
  const wire::Report& first = link.reports.front();
  const wire::Report& last = link.reports.back();
  const double scale = std::abs(first.momentum().linear(1));
  ASSERT_LT(std::abs(last.momentum().linear(1)), 0.9 * scale) << "too few have arrived";
  for (int c = 0; c < 2; ++c) {
    const double received = last.momentum().interface_impulse(c) - first.momentum().interface_impulse(c);
    EXPECT_NEAR(last.momentum().linear(c) - received, first.momentum().linear(c), 1e-12 * scale) << c;
  }
}

// A torque that one of two does not get is energy from nowhere: 11% of it here.
TEST(NativeBlocks, TorquesBetweenBlocksActOnBoth) {
  wire::Setup setup = discs(0.0);
  slug_of(setup).mutable_particle()->set_restitution(0.999);  // what dashpots take hides nothing
  const ScriptedLink link = run_with(2, setup);
  const wire::Energy& first = link.reports.front().energy();
  const wire::Energy& last = link.reports.back().energy();
  const double found = last.kinetic() + last.elastic() + last.damping() + last.friction() - last.interface_work();
  EXPECT_NEAR(found / first.kinetic(), 1.0, 0.01);
}

/// Forces and torques on each grain after some steps of a heap of turning discs, whose order in memory is another one
/// in each of them. `size` grains are a block.
std::vector<double> forces_in_heap(std::int32_t size) {
  constexpr std::int32_t rows = 12;
  constexpr std::int32_t count = rows * rows;
  constexpr double step = 1e-7;
  const SlugModel model = model_of(discs(0.0));
  std::mt19937_64 random(5);
  std::vector<PlacedParticle> placed(count);
  std::vector<std::int32_t> names(count);
  std::iota(names.begin(), names.end(), 0);
  for (std::int32_t n = 0; n < count; ++n) {
    PlacedParticle& one = placed[static_cast<std::size_t>(n)];
    one.position[0] = 0.98 * model.diameter * (n % rows);
    const std::int32_t row = n / rows;
    one.position[1] = 0.98 * model.diameter * row;
    one.spin = static_cast<double>(random() % 20001) - 10000.0;
  }
  base::Team team(1);
  native::Grains<2> grains(model, placed, names);
  const native::Allowance allowance{0.35 * model.diameter, model.diameter};
  native::Neighbours<2> neighbours(*native::available_sweeps().front(), allowance, allowance);
  const ContactLaw& law = model.pair_law;
  native::Contacts<2> contacts({law.normal_stiffness, law.tangential_stiffness, 0.0, law.friction}, {.dimension = 2},
                               grains, {count, size});
  std::vector<double> found;
  for (int n = 0; n < 6; ++n) {
    std::vector<std::uint8_t> fast(count);
    for (std::uint8_t& one : fast) one = random() % 2;
    const contact::ParticleArrays arrays = grains.arrays(count);
    std::for_each_n(arrays.force, count, [](double* force) { std::fill_n(force, 2, 0.0); });
    std::for_each_n(arrays.torque, count, [](double* torque) { torque[2] = 0.0; });
    neighbours.rebuild(team, grains, {count, size}, fast);
    contacts.follow(team, neighbours, grains);
    contacts.evaluate(team, grains, neighbours, step);
    found.assign(std::size_t{3} * count, 0.0);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      double* of_this = found.data() + std::ptrdiff_t{3} * arrays.identity[i];
      std::copy_n(arrays.force[i], 2, of_this);
      of_this[2] = arrays.torque[i][2] / model.diameter;
    }
  }
  return found;
}

// Nobody moves, so that the normal forces are always the same, and tangential springs grow with every step that is
// remembered. A grain's name must not decide which flags it gets, or contacts would stay in their blocks.
TEST(NativeBlocks, SpringsGoAlongToAnotherBlock) {
  const std::vector<double> whole = forces_in_heap(1024);
  const double largest = std::abs(
      *std::max_element(whole.begin(), whole.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  ASSERT_GT(largest, 0.0);
  for (const std::int32_t size : {1, 7, 40}) {
    const std::vector<double> parts = forces_in_heap(size);
    for (std::size_t n = 0; n < whole.size(); ++n) {
      ASSERT_NEAR(parts[n], whole[n], 1e-12 * largest) << "grain " << n / 3 << ", blocks of " << size;
    }
  }
}

}  // namespace
}  // namespace grainstep::dem
