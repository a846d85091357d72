// A slug of spheres on a rigid wall: its pressure does not depend on the slice, and is that of a front behind which the
// sand rests.
#include <gtest/gtest.h>

#include <numbers>

#include "../../unit/dem-service/slice_rig.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using rig::degree;

constexpr double diameter = 2e-3;
constexpr double slug_radius = 0.1;
constexpr double slug_height = 0.15;
constexpr double speed = 321.0;
constexpr double fraction = 0.2;
constexpr double ring = 5e-3;  // m
constexpr int seeds = 5;

/// Over rho_bar rho_s v0^2, means over time.
struct Wall {
  double pressure = 0.0;  ///< on the slug's disc, t_hat = 0.05 to 0.3
  double middle =
      0.0;  ///< on the rings from 12.5 to 62.5 mm up to t_hat = 0.2: later sand flows off sideways there, too
  double packed = 0.0;  ///< solid fraction behind the front, r from 25 to 60 mm, at t_hat = 0.35
};

struct Window {
  double begin, end;  // t_hat
};

double pressure_between(const rig::ScriptedLink& link, double dt, const Window& window, double from, double to) {
  double impulse = 0.0;
  double time = 0.0;
  for (const wire::Forces& forces : link.forces) {
    const double t_hat = static_cast<double>(forces.window()) * dt * speed / slug_height;
    if (t_hat < window.begin || t_hat > window.end) continue;
    time += dt;
    for (int i = 1; i < forces.impulse_size(); i += 2) {
      const double r = ring * (i / 2);
      if (r >= from && r < to) impulse -= forces.impulse(i);
    }
  }
  const double area = std::numbers::pi * (to * to - from * from);
  return impulse / (time * area * fraction * 2700.0 * speed * speed);
}

double packed_at(const wire::Snapshot& snapshot, double slice, double t_hat) {
  const double top = 0.5 * slug_height * t_hat * fraction / 0.6;  // the front is at twice that height
  double count = 0.0;
  for (int i = 0; i < snapshot.position_size() / 3; ++i) {
    const rig::Sphere sphere = rig::sphere_of(snapshot, i);
    const double r = std::hypot(sphere.position[0], sphere.position[2]);
    const double height = sphere.position[1];
    if (height > diameter && height < top && r > 0.025 && r < 0.06) count += 1.0;
  }
  const double room = 0.5 * slice * (0.06 * 0.06 - 0.025 * 0.025) * (top - diameter);
  return count * std::numbers::pi / 6.0 * diameter * diameter * diameter / room;
}

Wall impact(double slice, std::uint64_t seed) {
  constexpr double end = 0.35;
  wire::Setup setup = rig::slice_setup(slice);
  scene::Slug& slug = rig::slug_of(setup);
  slug.set_half_width(slug_radius);
  slug.set_height(slug_height);
  slug.set_relative_density(fraction);
  slug.set_speed(speed);
  slug.set_seed(seed);
  slug.mutable_particle()->set_diameter(diameter);
  slug.mutable_particle()->set_normal_stiffness(7.3e7);
  rig::set_rings(setup, 0.5, 100);
  const double dt = rig::model_of(setup).preferred_step;
  const auto steps = static_cast<std::uint64_t>(end * slug_height / speed / dt);
  const rig::ScriptedLink link = rig::run_slug(setup, rig::start_of(dt, steps));
  return {pressure_between(link, dt, {0.05, 0.3}, 0.0, slug_radius - 0.5 * ring),
          pressure_between(link, dt, {0.0, 0.2}, 0.0125, 0.0625), packed_at(link.snapshots.back(), slice, end)};
}

Wall mean(double slice) {
  Wall sum;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Wall one = impact(slice, static_cast<std::uint64_t>(seed));
    sum.pressure += one.pressure / seeds;
    sum.middle += one.middle / seeds;
    sum.packed += one.packed / seeds;
  }
  return sum;
}

void check(const std::string& quantity, const std::string& reference, double expected, double found, double tolerance,
           const std::string& reason) {
  verification::check({.group = "particles",
                       .name = "slug of spheres on a rigid wall",
                       .quantity = quantity,
                       .unit = "",
                       .reference = reference,
                       .origin = "p = rho_bar rho_s v0^2/(1 - rho_bar/rho_max)",
                       .expected = expected,
                       .found = found,
                       .tolerance = tolerance,
                       .reason = reason});
}

TEST(SlugOfSpheres, PressureDoesNotDependOnTheSliceAndIsThatOfAFront) {
  const Wall wide = mean(20.0 * degree);
  for (const double degrees : {5.0, 10.0}) {
    check("pressure over rho_bar rho_s v0^2, slice of " + std::to_string(static_cast<int>(degrees)) + " degrees",
          "slice of 20 degrees", wide.pressure, mean(degrees * degree).pressure, 0.03,
          "statistics: five seeds each; model: no sphere nearer to the axis than R/sin(phi/2)");
  }
  // Centres keep one radius from the slug's outline and from the planes: where they are, there are a few more of them.
  const double empty = 0.5 * diameter / std::sin(10.0 * degree);
  const double local = fraction * slug_radius * slug_radius /
                       (std::pow(slug_radius - 0.5 * diameter, 2) - empty * empty) * slug_height /
                       (slug_height - diameter);
  check("pressure of the middle rings over rho_bar rho_s v0^2, slice of 20 degrees",
        "front, rho_max = " + std::to_string(wide.packed).substr(0, 5) + " counted behind it",
        local / fraction / (1.0 - local / wide.packed), wide.middle, 0.05,
        "model: nothing moves behind the front; statistics: mean of five seeds");
  check("solid fraction behind the front, slice of 20 degrees",
        "random packings of spheres, 0.55 (loose) to 0.64 (close)", 0.595, wide.packed, 0.076,
        "model: half of that range; compacted sand still moves");
}

}  // namespace
}  // namespace grainstep::dem
