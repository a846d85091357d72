// The native engine's sweeps give the same bits whatever instruction set they are compiled for.
#include "dem-service/native/sweeps.hpp"

#include <gtest/gtest.h>

#include <random>

#include "dem-service/native/grains.hpp"

namespace grainstep::dem::native {
namespace {

constexpr std::int32_t count = 203;  // no multiple of any vector's length

SlugModel model_of(int dimension) {
  SlugModel model;
  model.diameter = 1e-3;
  model.density = dimension == 2 ? 2.7 : 2700.0;
  if (dimension == 3) model.slice = 0.5;
  return model;
}

template <int D>
class Cloud {
 public:
  explicit Cloud(const Sweeps& sweeps) : sweeps_(sweeps), grains_(model_of(D), particles(), identities()) {
    const double origin[3] = {-0.01, -0.01, -0.01};
    base::Team alone(1);
    grains_.set_origin(alone, origin, count);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> newtons(-1.0, 1.0);
    for (std::int32_t i = 0; i < count; ++i) {
      for (std::ptrdiff_t c = 0; c < D; ++c) grains_.force(i)[Row<D>::force + c] = newtons(random);
    }
    for (std::int32_t i = 0; i < count; ++i) {
      for (std::int32_t j = 0; j < i; ++j) pairs_.push_back({i, j});
    }
  }

  /// Everything that a step leaves, as bytes that can be compared.
  std::vector<double> step() {
    std::vector<double> out;
    base::Team alone(1);
    const double origin[3] = {0.0, 0.0, 0.0};
    grains_.set_origin(alone, origin, count);
    out.push_back(grains_.move(sweeps_, 3, count - 2, {{1.0, -2.0, 0.5}}, 1e-7, 1e-7));
    out.push_back(grains_.displaced(sweeps_, 0, count, {{1e-6, 0.0, 0.0}}));
    for (std::int32_t i = 0; i < count; ++i) {
      for (int c = 0; c < D; ++c) out.insert(out.end(), {grains_.position(i)[c], grains_.velocity(i)[c]});
      out.push_back(grains_.force(i)[Row<D>::force]);
    }
    const auto pairs = static_cast<std::ptrdiff_t>(pairs_.size());
    std::vector<Pair> listed = pairs_;
    listed.resize(listed.size() + lanes_at_once);
    std::vector<std::uint32_t> found(listed.size());
    const std::ptrdiff_t near = sweeps_.touching[D - 2](
        {.places = grains_.places(), .pairs = listed.data(), .last = pairs, .reach = 3e-3F, .slack = 1e-7F},
        found.data());
    EXPECT_GT(near, 50);
    EXPECT_LT(near, pairs / 2);
    out.insert(out.end(), found.begin(), found.begin() + near);
    std::vector<Pair> around(count + lanes_at_once);
    const std::vector<float> reach(count + lanes_at_once, 2e-3F);
    const Range all{0, count};
    const std::ptrdiff_t neighbours = sweeps_.near[D - 2]({grains_.places(), reach.data(), 11, &all, 1}, around.data());
    for (std::ptrdiff_t n = 0; n < neighbours; ++n) out.push_back(around[static_cast<std::size_t>(n)].second);
    return out;
  }

 private:
  static std::vector<PlacedParticle> particles() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-0.01, 0.01);
    std::vector<PlacedParticle> out(count);
    for (PlacedParticle& particle : out) {
      for (std::size_t c = 0; c < D; ++c) {
        particle.position[c] = place(random);
        particle.velocity[c] = 1e4 * place(random);
      }
    }
    return out;
  }
  static std::vector<std::int32_t> identities() {
    std::vector<std::int32_t> out(count);
    for (std::int32_t i = 0; i < count; ++i) out[static_cast<std::size_t>(i)] = i + 1;
    return out;
  }

  const Sweeps& sweeps_;
  Grains<D> grains_;
  std::vector<Pair> pairs_;
};

template <int D>
void expect_same_bits() {
  const std::vector<const Sweeps*>& all = available_sweeps();
  const std::vector<double> expected = Cloud<D>(*all.front()).step();
  for (const Sweeps* sweeps : all) EXPECT_EQ(Cloud<D>(*sweeps).step(), expected) << sweeps->name;
}

TEST(NativeSweeps, DiscsHaveTheSameBitsOnEveryInstructionSet) { expect_same_bits<2>(); }

TEST(NativeSweeps, SpheresHaveTheSameBitsOnEveryInstructionSet) { expect_same_bits<3>(); }

}  // namespace
}  // namespace grainstep::dem::native
