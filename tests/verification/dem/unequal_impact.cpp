// Head-on collisions of particles of different mass, with each other, with the structure, a mirror and a wall: every
// one returns the restitution that was asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "../../unit/dem-service/slice_rig.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using surface::Vec3;

constexpr double speed = 10.0;
constexpr int phases =
    110;  // not a divisor of the calibration's 400: other places of entry than those that it averages
constexpr double restitutions[] = {0.05, 0.3, 0.7, 0.95};

/// Discs or spheres whose masses are 1, 1.5, 3, 10, 30 and 100 times the smallest one's.
struct Family {
  bool spheres;
  [[nodiscard]] std::string name() const { return spheres ? "spheres" : "discs"; }
  [[nodiscard]] std::vector<double> sizes() const {
    std::vector<double> all;
    for (const double mass : {1.0, 1.5, 3.0, 10.0, 30.0, 100.0}) all.push_back(std::pow(mass, spheres ? 1.0 / 3 : 0.5));
    return all;
  }
  [[nodiscard]] wire::Setup setup(double restitution) const {
    wire::Setup setup = spheres ? rig::slice_setup(10.0 * rig::degree) : rig::reference_setup();
    scene::Slug& slug = rig::slug_of(setup);
    slug.set_half_width(0.2);
    slug.set_height(0.2);
    slug.mutable_particle()->set_restitution(restitution);
    slug.mutable_particle()->set_friction(0.0);
    scene::TabulatedSizes& table = *slug.mutable_size_distribution()->mutable_tabulated();
    for (const double size : sizes()) {
      table.add_size(size);
      table.add_fraction(1.0 / static_cast<double>(sizes().size()));
    }
    if (spheres) {
      rig::set_rings(setup, 40.0, 1000);
    } else {
      rig::set_flat_surface(setup, 40.0, 1000);
    }
    return setup;
  }
  /// In the plane, or on the middle of the slice beyond where its planes are narrow.
  [[nodiscard]] Vec3 place(double x, double height) const {
    if (!spheres) return {{x, height, 0.0}};
    Vec3 at = (0.3 + x) * rig::outward(5.0 * rig::degree);
    at[1] = height;
    return at;
  }
};

/// One after the other along x1, far from each other.
class Row {
 public:
  Row(const Family& family, const SlugModel& model) : family_(family), model_(model) {}

  /// Two diameters, the gap between them `gap` and the first one above; they meet at `speed`.
  void add_pair(double upper, double lower, double gap) {
    const double share = model_.mass_of(upper) / (model_.mass_of(upper) + model_.mass_of(lower));
    add(upper, 1.0 + 0.5 * (upper + gap), -(1.0 - share) * speed);
    add(lower, 1.0 - 0.5 * (lower + gap), share * speed, false);
  }
  void add_falling(double diameter, double gap) { add(diameter, 0.5 * diameter + gap, -speed); }

  std::vector<PlacedParticle> particles;

 private:
  void add(double diameter, double height, double velocity, bool ahead = true) {
    if (ahead) x_ += 3.0 * model_.largest();
    particles.push_back({family_.place(x_, height), {{0.0, velocity, 0.0}}, 0.0, diameter});
  }
  Family family_;
  SlugModel model_;
  double x_ = 0.0;
};

/// Velocities along x2 when all contacts are over.
std::vector<double> after(const wire::Setup& setup, double dt, const std::vector<PlacedParticle>& particles) {
  const SlugModel model = rig::model_of(setup);
  Collision slowest = model.on_surface;
  slowest.effective_mass = model.mass_of(model.largest());
  const auto steps = static_cast<std::uint64_t>(3.0 * contact_time(slowest) / dt);
  const rig::ScriptedLink link = rig::run(setup, rig::start_of(dt, steps), particles);
  const wire::Field& field = rig::field(link.snapshots.back(), "velocity");
  std::vector<double> found;
  for (int i = 1; i < field.value_size(); i += static_cast<int>(field.components())) found.push_back(field.value(i));
  EXPECT_EQ(found.size(), particles.size());
  return found;
}

void check(const std::string& name, const std::string& quantity, double worst) {
  verification::check({.group = "particles",
                       .name = name,
                       .quantity = quantity,
                       .unit = "",
                       .reference = "the scene's coefficient of restitution e",
                       .origin = "(2.3) with each contact's own effective mass, calibrated for the discrete scheme: "
                                 "docs/theory/particles.md",
                       .expected = 0.0,
                       .found = worst,
                       .tolerance = 1e-3,
                       .reason = "statistics: 110 phases of entry against the 400 of the calibration"});
}

std::string at(double e, double steps) {
  std::ostringstream text;
  text << ", e = " << e << ", step t_e/" << steps << " of the lightest";
  return text.str();
}

void check_pairs(const Family& family, double e, double steps) {
  const wire::Setup setup = family.setup(e);
  const SlugModel model = rig::model_of(setup);
  const double dt = model.contact_time / steps;
  const std::vector<double> sizes = family.sizes();
  Row row(family, model);
  for (const double a : sizes) {
    for (const double b : sizes) {
      if (b < a) continue;
      for (int k = 0; k < phases; ++k) {
        const double unit = model.smallest();
        row.add_pair(a * unit, b * unit, speed * dt * (k + 0.5) / phases);
      }
    }
  }
  const std::vector<double> v = after(setup, dt, row.particles);
  double worst = 0.0;
  for (std::size_t first = 0; first < v.size(); first += 2 * phases) {
    double mean = 0.0;
    for (std::size_t k = first; k < first + 2 * phases; k += 2) mean += (v[k] - v[k + 1]) / speed / phases;
    worst = verification::larger(worst, std::abs(mean - e));
  }
  check("restitution of unequal " + family.name(),
        "largest |mean e found - e| of 21 pairs of masses 1 to 100" + at(e, steps), worst);
}

void check_falls(const Family& family, double e, double steps) {
  const wire::Setup setup = family.setup(e);
  const SlugModel model = rig::model_of(setup);
  const double dt = model.contact_time / steps;
  Row row(family, model);
  for (const double size : family.sizes()) {
    for (int k = 0; k < phases; ++k) row.add_falling(size * model.smallest(), speed * dt * (k + 0.5) / phases);
  }
  const std::vector<double> v = after(setup, dt, row.particles);
  double worst = 0.0;
  for (std::size_t first = 0; first < v.size(); first += phases) {
    double mean = 0.0;
    for (std::size_t k = first; k < first + phases; ++k) mean += v[k] / speed / phases;
    worst = verification::larger(worst, std::abs(mean - e));
  }
  check("restitution of unequal " + family.name(),
        "largest |mean e found - e| on the structure, six masses 1 to 100" + at(e, steps), worst);
}

TEST(UnequalImpact, PairsReturnTheRestitution) {
  for (const bool spheres : {false, true}) {
    for (const double e : restitutions) check_pairs({spheres}, e, 10.0);
    check_pairs({spheres}, 0.7, 5.0);
    check_pairs({spheres}, 0.7, 50.0);
  }
}

TEST(UnequalImpact, TheStructureReturnsTheRestitution) {
  for (const bool spheres : {false, true}) {
    for (const double e : restitutions) check_falls({spheres}, e, 10.0);
  }
}

/// Discs of two masses, 1 and 100, each against the mirror and then the wall of its strip.
TEST(UnequalImpact, MirrorAndWallReturnTheRestitution) {
  constexpr double e = 0.7;
  wire::Setup setup = Family{false}.setup(e);
  setup.set_mirror(true);
  rig::slug_of(setup).set_confined(true);
  const SlugModel model = rig::model_of(setup);
  const double dt = model.preferred_step;
  std::vector<PlacedParticle> particles;
  for (int k = 0; k < phases; ++k) {
    for (const double size : {model.smallest(), model.largest()}) {
      const double from_plane = 0.5 * size + speed * dt * (k + 0.5) / phases;
      const double height = 2.0 * model.largest() * (1.0 + 0.5 * static_cast<double>(particles.size()));
      particles.push_back({{{from_plane, height}}, {{-speed, 0.0}}, 0.0, size});
      particles.push_back({{{model.half_width - from_plane, height}}, {{speed, 0.0}}, 0.0, size});
    }
  }
  const rig::ScriptedLink link = rig::run(setup, rig::start_of(dt, 450), particles);
  const wire::Field& v = rig::field(link.snapshots.back(), "velocity");
  double mean[2][2] = {};  // [mirror, wall][small, large]
  for (int i = 0; i < 4 * phases; ++i)
    mean[i % 2][i / 2 % 2] += (i % 2 == 0 ? 1 : -1) * v.value(2 * i) / speed / phases;
  check("restitution of unequal discs", "largest |mean e found - e| at the mirror, masses 1 and 100" + at(e, 10.0),
        std::max(std::abs(mean[0][0] - e), std::abs(mean[0][1] - e)));
  check("restitution of unequal discs", "largest |mean e found - e| at a wall, masses 1 and 100" + at(e, 10.0),
        std::max(std::abs(mean[1][0] - e), std::abs(mean[1][1] - e)));
}

}  // namespace
}  // namespace grainstep::dem
