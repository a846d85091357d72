#include "fe-service/foam/model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "fe-service/deformable.hpp"
#include "scene/core.hpp"

namespace grainstep::fe {
namespace {

/// A node's skin over an element: as thick as the block's nodes come near each other when it locks, so that a corner
/// is met by a rounded node rather than a point, and the penetration at first touch stays inside.
constexpr double kSkin = 0.25;

void check(const scene::Impactor& impactor, double depth, bool mirror) {
  const scene::Slug& slug = impactor.slug();
  if (impactor.type() != scene::Impactor::TYPE_FOAM || !impactor.has_slug())
    throw InputError("impactor: a foam projectile needs the type `foam` and the slug that it is equivalent to");
  if (!(depth > 0.0) || !(slug.half_width() > 0.0) || !(slug.height() > 0.0) || !(slug.speed() > 0.0))
    throw InputError("impactor.slug: half_width, height, speed and the scene's depth must be above 0 for a foam");
  if (!(locking_strain(impactor) > 0.0)) {
    throw InputError(fmt::format(
        "impactor.foam.densest: {:g} leaves a foam of relative density {:g} nothing to compact; raise it above that",
        impactor.foam().densest(), slug.relative_density()));
  }
  const bool straight = slug.angle() == 0.0 && slug.offset() == 0.0;
  if (mirror && !straight) {
    throw InputError(
        fmt::format("impactor.slug: angle {:g} and offset {:g} m have no mirror image: take structure.extent: full",
                    slug.angle(), slug.offset()));
  }
  if (slug.confined() && !straight)
    throw InputError("impactor.slug.confined: the walls stand at |x1| = half_width: angle and offset must be 0");
}

Foam make_foam(const scene::Impactor& impactor, double depth) {
  const scene::Slug& slug = impactor.slug();
  const scene::Foam& keys = impactor.foam();
  const double density = foam_density(slug);
  const double young = 0.75 * std::sqrt(3.0) * slug.particle().normal_stiffness() / depth;  // (4.11)
  const double strain = locking_strain(impactor);
  return {Elastic::from_young(young, keys.poisson(), density), keys.strength() * density * slug.speed() * slug.speed(),
          -std::log1p(-strain),
          scene::shock_viscosity(keys.shock_width() * slug.height(), density, slug.speed(), strain)};
}

Mesh make_block(const scene::Impactor& impactor, bool mirror) {
  const scene::Slug& slug = impactor.slug();
  const int rows = static_cast<int>(impactor.foam().elements());
  const double size = slug.height() / rows;
  const int half_columns = static_cast<int>(std::max(1.0, std::round(slug.half_width() / size)));
  Mesh mesh{};
  mesh.symmetric = mirror;
  mesh.element_size = size;
  mesh.left = mirror ? 0.0 : -slug.half_width();
  mesh.length = (mirror ? 1.0 : 2.0) * slug.half_width();
  mesh.columns = half_columns * (mirror ? 1 : 2);
  mesh.mid_column = mirror ? 0 : half_columns;
  mesh.width = mesh.length / mesh.columns;
  for (int row = 0; row < rows; ++row) mesh.rows.push_back({0, size, mesh.width * size});
  for (int row = 0; row <= rows; ++row) mesh.level.push_back(slug.height() * (rows - row) / rows);
  return mesh;
}

}  // namespace

double foam_density(const scene::Slug& slug) { return slug.relative_density() * slug.particle().density(); }

double locking_strain(const scene::Impactor& impactor) {
  return 1.0 - impactor.slug().relative_density() / impactor.foam().densest();
}

FoamModel make_foam_model(const scene::Impactor& impactor, double depth, bool mirror) {
  check(impactor, depth, mirror);
  const scene::Slug& slug = impactor.slug();
  FoamModel model{};
  model.mesh = make_block(impactor, mirror);
  model.foam = make_foam(impactor, depth);
  model.depth = depth;
  model.height = slug.height();
  model.speed = slug.speed();
  model.tail_speed = slug.has_tail_speed() ? slug.tail_speed() : slug.speed();
  model.angle = slug.angle();
  model.offset = slug.offset();
  model.stand_off = slug.stand_off();
  model.confined = slug.confined();
  model.radius = kSkin * model.mesh.element_size;
  model.contact_stiffness = impactor.foam().contact_stiffness() * model.foam.elastic.longitudinal_modulus() * depth;
  model.friction = impactor.foam().friction();
  model.tangential_stiffness = slug.particle().tangential_ratio() * model.contact_stiffness;
  return model;
}

double stable_step_in_touch(const FoamModel& model, double elements) {
  const double quad = model.foam.elastic.density * model.depth * model.mesh.rows.front().quad_area;
  const double added = model.contact_stiffness / (quad / 6.0);  // a corner of the block
  return 2.0 / std::sqrt(4.0 / (elements * elements) + added);
}

double preferred_foam_step(const scene::Impactor& impactor, double stable_step) {
  return kStepSafety * stable_step * std::sqrt(1.0 - locking_strain(impactor));
}

}  // namespace grainstep::fe
