// The native engine misses no contact: at every step of whole events all touching pairs are looked for by another
// method and compared with those that it computed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "contact/moving_surface.hpp"
#include "engine_rig.hpp"
#include "slice_rig.hpp"

namespace grainstep::dem {
namespace {

using namespace rig;

/// By sorting along x1 alone: nothing is assumed about speeds, steps or where anybody was before.
class Search {
 public:
  using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

  const Pairs& touching(const contact::ParticleArrays& grains) {
    order_.resize(static_cast<std::size_t>(grains.owned));
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(),
              [&](int a, int b) { return grains.position[a][0] < grains.position[b][0]; });
    const double widest = *std::max_element(grains.radius, grains.radius + grains.owned);
    pairs_.clear();
    for (std::size_t n = 0; n < order_.size(); ++n) {
      const int a = order_[n];
      for (std::size_t m = n + 1; m < order_.size(); ++m) {
        const int b = order_[m];
        const double* x = grains.position[a];
        const double* y = grains.position[b];
        if (y[0] - x[0] >= grains.radius[a] + widest) break;
        double squared = 0.0;
        for (int c = 0; c < 3; ++c) squared += (x[c] - y[c]) * (x[c] - y[c]);
        const double reach = grains.radius[a] + grains.radius[b];
        if (squared < reach * reach) pairs_.push_back(std::minmax(grains.identity[a], grains.identity[b]));
      }
    }
    std::sort(pairs_.begin(), pairs_.end());
    return pairs_;
  }

 private:
  std::vector<int> order_;
  Pairs pairs_;
};

struct Compared {
  std::uint64_t contacts = 0;
  std::uint64_t differences = 0;
};

Compared compare(const wire::Setup& setup, double duration, std::vector<PlacedParticle> particles = {}) {
  const SlugModel model = slug_model_of(setup);
  if (particles.empty()) particles = lay_out(model, contact::MovingSurface(setup.impactor().surface()).now());
  const double dt = model.preferred_step;
  const wire::Start start = start_of(dt, static_cast<std::uint64_t>(duration / dt));
  ScriptedLink link(setup, start, at_rest());
  const auto engine = native::make_engine(model, setup.impactor(), std::move(particles));
  Compared out;
  Search search;
  Search::Pairs found;
  engine->watch([&](const native::View& view) {
    found.clear();
    for (const Pair& pair : view.touching) {
      found.push_back(std::minmax(view.grains.identity[pair.first], view.grains.identity[pair.second]));
    }
    std::sort(found.begin(), found.end());
    const Search::Pairs& right = search.touching(view.grains);
    out.contacts += right.size();
    if (found != right) ++out.differences;
  });
  engine->run(start, link);
  return out;
}

wire::Setup discs() {
  wire::Setup setup = reference_setup();
  set_flat_surface(setup, 0.1, 40);
  return setup;
}

/// Until the slug has come to the surface and its sand has spread.
double event_of(const wire::Setup& setup) {
  const scene::Slug& slug = setup.impactor().impactor().slug();
  return 2.0 * (slug.height() + slug.stand_off()) / slug.speed();
}

void expect_all(const wire::Setup& setup, std::uint64_t at_least) {
  const Compared compared = compare(setup, event_of(setup));
  EXPECT_EQ(compared.differences, 0U);
  EXPECT_GT(compared.contacts, at_least);
}

TEST(NativeContacts, NoneIsMissedAtTheSpeedOfThePaper) { expect_all(discs(), 50'000); }

TEST(NativeContacts, NoneIsMissedAtManyTimesThatSpeed) {
  wire::Setup setup = discs();
  slug_of(setup).set_speed(1500.0);
  slug_of(setup).mutable_particle()->set_normal_stiffness(1e8);
  expect_all(setup, 30'000);
}

TEST(NativeContacts, NoneIsMissedOfDenseSandThatStandsOff) {
  wire::Setup setup = discs();
  slug_of(setup).set_relative_density(0.45);
  slug_of(setup).set_stand_off(0.01);
  slug_of(setup).set_height(0.02);
  expect_all(setup, 50'000);
}

TEST(NativeContacts, NoneIsMissedOfAnObliqueSlug) {
  wire::Setup setup = discs();
  slug_of(setup).set_angle(0.6);
  expect_all(setup, 30'000);
}

TEST(NativeContacts, NoneIsMissedWhereTheTailOvertakesTheHead) {
  wire::Setup setup = discs();
  slug_of(setup).set_tail_speed(700.0);
  expect_all(setup, 50'000);
}

TEST(NativeContacts, NoneIsMissedBetweenWallsAndMirror) {
  wire::Setup setup = discs();
  slug_of(setup).set_confined(true);
  setup.set_mirror(true);
  expect_all(setup, 50'000);
}

// More grains than one block has (native/blocks.hpp).
TEST(NativeContacts, NoneIsMissedBetweenBlocks) {
  wire::Setup setup = discs();
  slug_of(setup).mutable_particle()->set_diameter(0.3e-3);
  expect_all(setup, 2'000'000);
}

TEST(NativeContacts, NoneIsMissedOfManySizes) {
  wire::Setup setup = discs();
  auto& sizes = *slug_of(setup).mutable_size_distribution();
  sizes.set_by(scene::SizeDistribution::BY_NUMBER);
  sizes.mutable_uniform()->set_width(0.6);
  expect_all(setup, 10'000);
}

// The first one stays where it fell; nothing else moves that would make the list old while the second one comes.
TEST(NativeContacts, WhoFollowsFarBehindIsNotMissed) {
  wire::Setup setup = discs();
  slug_of(setup).mutable_surface_contact()->set_restitution(0.05);
  const surface::Vec3 down{{0.0, -400.0, 0.0}};
  std::vector<PlacedParticle> particles;
  particles.reserve(5);
  for (int i = 0; i < 5; ++i) particles.push_back({{{0.0, 0.6e-3 + 12e-3 * i, 0.0}}, down, 0.0, 0.0});
  const Compared compared = compare(setup, 0.2e-3, particles);
  EXPECT_EQ(compared.differences, 0U);
  EXPECT_GT(compared.contacts, 20U);
}

TEST(NativeContacts, NoneIsMissedOfSpheresInASlice) {
  wire::Setup setup = slice_setup();
  set_rings(setup, 0.1, 40);
  expect_all(setup, 50'000);
}

}  // namespace
}  // namespace grainstep::dem
