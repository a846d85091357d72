#include "fe-service/foam/model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "fe-service/deformable.hpp"
#include "fe-service/solid.hpp"
#include "scene/core.hpp"
#include "scene/foam.hpp"

namespace grainstep::fe {
namespace {

/// A node's skin over an element: as thick as the block's nodes come near each other when it locks, so that a corner
/// is met by a rounded node rather than a point, and the penetration at first touch stays inside.
constexpr double kSkin = 0.25;

void check(const scene::Impactor& impactor, const FoamSetting& setting) {
  const scene::Slug& slug = impactor.slug();
  if (impactor.type() != scene::Impactor::TYPE_FOAM || !impactor.has_slug())
    throw InputError("impactor: a foam projectile needs the type `foam` and the slug that it is equivalent to");
  const bool ring = setting.symmetry == scene::SYMMETRY_AXISYMMETRIC;
  if (!(ring || setting.depth > 0.0) || !(slug.half_width() > 0.0) || !(slug.height() > 0.0) || !(slug.speed() > 0.0))
    throw InputError("impactor.slug: half_width, height, speed and the scene's depth must be above 0 for a foam");
  if (!(scene::locking_strain(impactor, setting.symmetry) > 0.0)) {
    throw InputError(fmt::format(
        "impactor.foam.densest: {:g} leaves a foam of relative density {:g} nothing to compact; raise it above that",
        scene::densest_packing(impactor.foam(), setting.symmetry), slug.relative_density()));
  }
  const bool straight = slug.angle() == 0.0 && slug.offset() == 0.0;
  if (ring && !straight) {
    throw InputError(
        fmt::format("impactor.slug: angle {:g} and offset {:g} m leave no solid of revolution; both must be 0",
                    slug.angle(), slug.offset()));
  }
  if (setting.mirror && !straight) {
    throw InputError(
        fmt::format("impactor.slug: angle {:g} and offset {:g} m have no mirror image: take structure.extent: full",
                    slug.angle(), slug.offset()));
  }
  if (slug.confined() && !straight)
    throw InputError("impactor.slug.confined: the walls stand at |x1| = half_width: angle and offset must be 0");
}

Foam make_foam(const scene::Impactor& impactor, const FoamSetting& setting) {
  const scene::Slug& slug = impactor.slug();
  const scene::Foam& keys = impactor.foam();
  const double density = scene::foam_density(slug);
  const double young = scene::foam_modulus(slug.particle(), setting.symmetry, setting.depth);
  const double strain = scene::locking_strain(impactor, setting.symmetry);
  return {Elastic::from_young(young, keys.poisson(), density), keys.strength() * density * slug.speed() * slug.speed(),
          -std::log1p(-strain),
          scene::shock_viscosity(keys.shock_width() * slug.height(), density, slug.speed(), strain)};
}

/// `half`: x1 begins at the plane or axis of symmetry.
Mesh make_block(const scene::Impactor& impactor, bool half) {
  const scene::Slug& slug = impactor.slug();
  const int rows = static_cast<int>(impactor.foam().elements());
  const double size = slug.height() / rows;
  const double wanted = std::max(1.0, std::round(slug.half_width() / size));
  require_fits(wanted * rows * (half ? 1.0 : 2.0),
               fmt::format("impactor.foam.elements: {} over the height gives {:g} x {} elements of {:g} m", rows,
                           wanted, rows, size));
  const int half_columns = static_cast<int>(wanted);
  Mesh mesh{};
  mesh.symmetric = half;
  mesh.element_size = size;
  mesh.left = half ? 0.0 : -slug.half_width();
  mesh.length = (half ? 1.0 : 2.0) * slug.half_width();
  mesh.columns = half_columns * (half ? 1 : 2);
  mesh.mid_column = half ? 0 : half_columns;
  mesh.width = mesh.length / mesh.columns;
  for (int row = 0; row < rows; ++row) mesh.rows.push_back({0, size, mesh.width * size});
  for (int row = 0; row <= rows; ++row) mesh.level.push_back(slug.height() * (rows - row) / rows);
  return mesh;
}

}  // namespace

FoamModel make_foam_model(const scene::Impactor& impactor, const FoamSetting& setting) {
  const Measure measure = make_measure(setting.symmetry, setting.depth);
  check(impactor, setting);
  const scene::Slug& slug = impactor.slug();
  FoamModel model{};
  model.mesh = make_block(impactor, setting.mirror || is_of_revolution(measure));
  model.foam = make_foam(impactor, setting);
  model.measure = measure;
  model.height = slug.height();
  model.speed = slug.speed();
  model.tail_speed = slug.has_tail_speed() ? slug.tail_speed() : slug.speed();
  model.angle = slug.angle();
  model.offset = slug.offset();
  model.stand_off = slug.stand_off();
  model.confined = slug.confined();
  model.radius = kSkin * model.mesh.element_size;
  model.contact_stiffness =
      impactor.foam().contact_stiffness() * model.foam.elastic.longitudinal_modulus() / model.mesh.element_size;
  model.friction = impactor.foam().friction();
  model.tangential_stiffness = slug.particle().tangential_ratio() * model.contact_stiffness;
  return model;
}

double preferred_foam_step(const FoamModel& model, double stable_step) {
  return kStepSafety * stable_step * std::exp(-0.5 * model.foam.locked);
}

}  // namespace grainstep::fe
