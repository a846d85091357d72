#include "dem-service/slug/preview.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "dem-service/slug/model.hpp"
#include "slice_rig.hpp"

namespace grainstep::dem {
namespace {

scene::Impactor impactor() { return rig::reference_setup().impactor().impactor(); }

SlugPreview preview_of(const scene::Impactor& what) { return preview(what, scene::SYMMETRY_PLANE_STRAIN, 1e-3, true); }

TEST(Preview, ReferenceSlugOfThePaper) {
  scene::Impactor paper = impactor();
  paper.mutable_slug()->mutable_particle()->set_diameter(200e-6);
  paper.mutable_slug()->set_half_width(0.1);
  paper.mutable_slug()->set_height(0.3);
  const SlugPreview found = preview_of(paper);
  EXPECT_EQ(found.particles, 190986U);  // 0.2 a H / (pi D^2/4)
  EXPECT_NEAR(found.particle_mass, 8.482e-8, 5e-12);
  EXPECT_DOUBLE_EQ(found.mass, 190986.0 * found.particle_mass);
  EXPECT_NEAR(found.contact_time, 2.410e-7, 5e-11);
  EXPECT_NEAR(found.preferred_step, 2.41e-8, 5e-11);
  EXPECT_GT(found.stable_step, found.preferred_step);
  EXPECT_GT(found.memory_bytes, 100'000'000U);
  EXPECT_GT(found.seconds_per_particle_step, 1e-8);
}

void expect_refused(const scene::Impactor& what, const std::string& key) {
  try {
    (void)preview_of(what);
    FAIL() << key;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(key));
  }
}

TEST(Preview, ManySizes) {
  scene::Impactor mixed = impactor();
  scene::SizeDistribution& sizes = *mixed.mutable_slug()->mutable_size_distribution();
  sizes.set_by(scene::SizeDistribution::BY_MASS);
  sizes.mutable_bidisperse()->set_ratio(3.0);
  sizes.mutable_bidisperse()->set_large(0.5);
  const SlugPreview equal = preview_of(impactor());
  const SlugPreview found = preview_of(mixed);
  EXPECT_NEAR(found.smallest, 0.5e-3, 1e-12);
  EXPECT_NEAR(found.largest, 1.5e-3, 1e-12);
  // Half the mass in discs of a quarter of the mean one's, half in discs of 2.25 times that.
  EXPECT_NEAR(static_cast<double>(found.particles) / static_cast<double>(equal.particles), 2.0 + 1.0 / 4.5, 3e-3);
  EXPECT_NEAR(found.particle_mass * static_cast<double>(found.particles), 0.2 * 0.02 * 0.04 * 1e-3 * 2700.0, 1e-12);
  EXPECT_NEAR(found.contact_mass / equal.contact_mass, 2.25, 1e-12);
  EXPECT_NEAR(found.contact_time / equal.contact_time, 0.5, 1e-12);  // as the root of the mass
  EXPECT_NEAR(found.preferred_step / equal.preferred_step, 0.5, 1e-12);
  EXPECT_GT(found.seconds_per_particle_step, equal.seconds_per_particle_step);

  sizes.mutable_uniform()->set_width(0.9);
  expect_refused(mixed, "size_distribution.uniform.width");

  // A class of less than half a particle, which carries 2% of the mass.
  scene::Impactor rare = impactor();
  scene::TabulatedSizes& table = *rare.mutable_slug()->mutable_size_distribution()->mutable_tabulated();
  for (const double size : {1.0, 10.0}) table.add_size(size);
  for (const double fraction : {0.9998, 0.0002}) table.add_fraction(fraction);
  expect_refused(rare, "too few");
}

TEST(Preview, RefusesWhatCannotBeComputed) {
  scene::Impactor dense = impactor();
  dense.mutable_slug()->set_relative_density(0.6);
  expect_refused(dense, "relative_density");
  scene::Impactor thin = impactor();
  thin.mutable_slug()->set_half_width(1e-4);
  expect_refused(thin, "half_width");
  scene::Impactor other = impactor();
  other.set_type(scene::Impactor::TYPE_EXTERNAL);
  expect_refused(other, "impactor.type");
}

/// Sums over the contacts of a particle in the densest packing, per direction: of the squares along the normals, and of
/// those along the tangents.
struct Directions {
  double normal, tangential;
};

Directions of_closest_spheres() {
  std::vector<surface::Vec3> normals;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      for (const surface::Vec3& n :
           {surface::Vec3{{a, b, 0.0}}, surface::Vec3{{a, 0.0, b}}, surface::Vec3{{0.0, a, b}}})
        normals.push_back(std::sqrt(0.5) * n);
    }
  }
  double along = 0.0;
  for (const surface::Vec3& n : normals) along += n[0] * n[0];
  return {along, static_cast<double>(normals.size()) - along};
}

// A contact adds at most 2 Kn/m along its normal; along its tangent 2 Ks/m from motion and 2 R^2/I Ks from rotation.
TEST(StableStep, NeighboursAreThoseOfTheDensestPacking) {
  constexpr double of_a_sphere = 2.0 / 5.0, of_a_disc = 1.0 / 2.0;  // I over m R^2
  const Directions spheres = of_closest_spheres();
  EXPECT_DOUBLE_EQ(neighbours_of_a_sphere.normal, 2.0 * spheres.normal);
  EXPECT_DOUBLE_EQ(neighbours_of_a_sphere.tangential, (2.0 + 2.0 / of_a_sphere) * spheres.tangential);
  EXPECT_DOUBLE_EQ(neighbours_of_a_sphere.damping, spheres.normal);
  const Directions discs{3.0, 3.0};  // six at 60 degrees
  EXPECT_DOUBLE_EQ(neighbours_of_a_disc.normal, 2.0 * discs.normal);
  EXPECT_DOUBLE_EQ(neighbours_of_a_disc.tangential, (2.0 + 2.0 / of_a_disc) * discs.tangential);
  EXPECT_DOUBLE_EQ(neighbours_of_a_disc.damping, discs.normal);
}

TEST(StableStep, AModelTakesItsOwnKindOfNeighbours) {
  for (const bool spheres : {false, true}) {
    const wire::Setup setup = spheres ? rig::slice_setup() : rig::reference_setup();
    const SlugModel model = rig::model_of(setup);
    const Neighbours& neighbours = spheres ? neighbours_of_a_sphere : neighbours_of_a_disc;
    EXPECT_DOUBLE_EQ(model.stable_step,
                     largest_stable_step(model.pair, model.pair_law.tangential_stiffness, neighbours));
    EXPECT_DOUBLE_EQ(model.preferred_step, std::min(model.contact_time / 10.0, model.stable_step));
    EXPECT_GT(model.pair_law.tangential_stiffness, 0.0);
  }
}

TEST(StableStep, CoversTheStiffestModeOfAPackedLattice) {
  // Elastic and frictionless: omega^2 = 6 Kn/m, and the limit of central differences is 2/omega.
  const double mass = 2.0;
  const Collision pair{50.0, mass / 2.0, 1.0, false};
  EXPECT_DOUBLE_EQ(largest_stable_step(pair, 0.0), 2.0 / std::sqrt(6.0 * 50.0 / mass));
  Collision damped = pair;
  damped.restitution = 0.5;
  EXPECT_LT(largest_stable_step(damped, 0.0), largest_stable_step(pair, 0.0));
  EXPECT_LT(largest_stable_step(pair, 10.0), largest_stable_step(pair, 0.0));
}

}  // namespace
}  // namespace grainstep::dem
