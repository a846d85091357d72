#include "scene/foam.hpp"

#include <cmath>

namespace grainstep::scene {
namespace {

constexpr double densest_discs = 0.9;
constexpr double densest_spheres = 0.74;

}  // namespace

double foam_density(const Slug& slug) { return slug.relative_density() * slug.particle().density(); }

double densest_packing(const Foam& foam, Symmetry symmetry) {
  if (foam.has_densest()) return foam.densest();
  return symmetry == SYMMETRY_AXISYMMETRIC ? densest_spheres : densest_discs;
}

double locking_strain(const Impactor& impactor, Symmetry symmetry) {
  return 1.0 - impactor.slug().relative_density() / densest_packing(impactor.foam(), symmetry);
}

double foam_modulus(const Particle& particle, Symmetry symmetry, double depth) {
  if (symmetry == SYMMETRY_AXISYMMETRIC)
    return 4.0 / 3.0 * std::sqrt(2.0) * particle.normal_stiffness() / particle.diameter();
  return 0.75 * std::sqrt(3.0) * particle.normal_stiffness() / depth;
}

double strain_behind_shock(const Scene& scene) {
  const Slug& slug = scene.impactor().slug();
  const double nu = scene.impactor().foam().poisson();
  const double modulus =
      foam_modulus(slug.particle(), scene.symmetry(), scene.depth()) * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  const double pressure =
      foam_density(slug) * slug.speed() * slug.speed() / locking_strain(scene.impactor(), scene.symmetry());
  return pressure / modulus;
}

}  // namespace grainstep::scene
