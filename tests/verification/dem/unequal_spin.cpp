// Two particles of different size that meet head-on while they spin: rebound over the spin against the same law as an
// ordinary differential equation. The plan is that of test 8 of Chung and Ooi (Granular Matter 13, 2011): one approach
// speed, different spins; their spheres are Hertzian.
#include <gtest/gtest.h>

#include "../../unit/dem-service/slice_rig.hpp"
#include "contact_ode.hpp"
#include "support/verification_record.hpp"

namespace grainstep::dem {
namespace {

using namespace impacts;
using surface::Vec3;

constexpr double speed = 3.9;  // m/s, of approach
constexpr double ratio = 5.0;  // of the diameters
constexpr int phases = 10;     // of entry

wire::Setup setup_of_pairs(bool spheres) {
  wire::Setup setup = spheres ? rig::slice_setup(10.0 * rig::degree) : rig::reference_setup();
  rig::slug_of(setup).set_half_width(0.2);  // wide enough for three of the large ones at the slice's rim
  rig::slug_of(setup).set_height(0.2);
  scene::TabulatedSizes& table = *rig::slug_of(setup).mutable_size_distribution()->mutable_tabulated();
  for (const double size : {1.0, ratio}) {
    table.add_size(size);
    table.add_fraction(0.5);
  }
  spheres ? rig::set_rings(setup, 40.0, 1000) : rig::set_flat_surface(setup, 40.0, 1000);
  return setup;
}

/// Spins that make up to four times the approach speed at the small one's rim; the large one's rim turns with it,
/// against it, or not at all.
std::vector<Relative> over_spins(double small, double large) {
  std::vector<Relative> all;
  for (double rim = -4.0; rim <= 4.0; rim += 0.5) {
    for (const double other : {-0.5, 0.0, 1.0}) {
      all.push_back({speed, 0.0, rim * speed / small, other * rim * speed / large});
    }
  }
  return all;
}

class Pairs {
 public:
  explicit Pairs(bool spheres) : spheres_(spheres), setup_(setup_of_pairs(spheres)), model_(rig::model_of(setup_)) {}

  [[nodiscard]] double small() const { return 0.5 * model_.smallest(); }
  [[nodiscard]] double large() const { return 0.5 * model_.largest(); }

  [[nodiscard]] std::vector<Relative> by_ode(const std::vector<Relative>& before) const {
    const scene::Particle& particle = rig::slug_of(const_cast<wire::Setup&>(setup_)).particle();
    const ContactOde ode({.restitution = particle.restitution(),
                          .friction = particle.friction(),
                          .tangential_ratio = particle.tangential_ratio()},
                         particle.normal_stiffness(), body(small()), body(large()));
    std::vector<Relative> after;
    for (const Relative& one : before) after.push_back(ode.rebound(one));
    return after;
  }

  /// Means over the phase of entry; the step is t_e/`steps` of this pair.
  [[nodiscard]] std::vector<Relative> by_engine(const std::vector<Relative>& before, double steps) const {
    Collision pair = model_.pair;
    pair.effective_mass = 1.0 / (1.0 / body(small()).mass + 1.0 / body(large()).mass);
    const double dt = contact_time(pair) / steps;
    std::vector<PlacedParticle> particles;
    for (std::size_t i = 0; i < before.size(); ++i) {
      for (int k = 0; k < phases; ++k) place(before[i], speed * dt * (k + 0.5) / phases, particles);
    }
    const auto count = static_cast<std::uint64_t>(2.0 * steps);
    const rig::ScriptedLink link = rig::run(setup_, rig::start_of(dt, count), particles);
    return means_of(link.snapshots.back(), before.size());
  }

 private:
  [[nodiscard]] Round body(double radius) const { return {model_.mass_of(2.0 * radius), radius, spheres_ ? 0.4 : 0.5}; }

  /// The small one above, both far above the surface and from the next pair. In the plane of x1 and x2: of a slice of
  /// spheres, near its first plane at that distance from the axis.
  void place(const Relative& motion, double gap, std::vector<PlacedParticle>& particles) const {
    const double x = 0.5 + 3.0 * model_.largest() * static_cast<double>(particles.size() / 2);
    const double z = spheres_ ? 0.5 * x * std::tan(10.0 * rig::degree) : 0.0;
    const double share = body(large()).mass / (body(small()).mass + body(large()).mass);
    particles.push_back(
        {{{x, 1.0 + small() + gap, z}}, {{0.0, -share * motion.normal, 0.0}}, motion.spin, 2.0 * small()});
    particles.push_back(
        {{{x, 1.0 - large(), z}}, {{0.0, (1.0 - share) * motion.normal, 0.0}}, motion.other_spin, 2.0 * large()});
  }

  [[nodiscard]] std::vector<Relative> means_of(const wire::Snapshot& snapshot, std::size_t count) const {
    const wire::Field& velocity = rig::field(snapshot, "velocity");
    const wire::Field& spin = rig::field(snapshot, "angular_velocity");
    const auto v = [&](int particle, int c) {
      return velocity.value(static_cast<int>(velocity.components()) * particle + c);
    };
    const auto about_x3 = [&](int particle) {
      const auto components = static_cast<int>(spin.components());
      return spin.value(components * particle + components - 1);
    };
    std::vector<Relative> means(count);
    for (int i = 0; i < static_cast<int>(count) * phases; ++i) {
      Relative& mean = means[static_cast<std::size_t>(i / phases)];
      mean.normal += (v(2 * i, 1) - v(2 * i + 1, 1)) / phases;
      mean.tangential += (v(2 * i, 0) - v(2 * i + 1, 0)) / phases;
      mean.spin += about_x3(2 * i) / phases;
      mean.other_spin += about_x3(2 * i + 1) / phases;
    }
    return means;
  }

  bool spheres_;
  wire::Setup setup_;
  SlugModel model_;
};

/// Largest error of any velocity of any impact, rim speeds included, over the root of the sum of squares before.
double error_of(const Pairs& pairs, const std::vector<Relative>& before, const std::vector<Relative>& expected,
                const std::vector<Relative>& found) {
  double worst = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double rims = std::hypot(pairs.small() * before[i].spin, pairs.large() * before[i].other_spin);
    const double scale = std::hypot(before[i].normal, rims);
    for (const double difference : {found[i].normal - expected[i].normal, found[i].tangential - expected[i].tangential,
                                    pairs.small() * (found[i].spin - expected[i].spin),
                                    pairs.large() * (found[i].other_spin - expected[i].other_spin)}) {
      worst = verification::larger(worst, std::abs(difference) / scale);
    }
  }
  return worst;
}

void check(bool spheres) {
  const Pairs pairs(spheres);
  const std::vector<Relative> before = over_spins(pairs.small(), pairs.large());
  const std::vector<Relative> expected = pairs.by_ode(before);
  const double at_10 = error_of(pairs, before, expected, pairs.by_engine(before, 10.0));
  const double at_160 = error_of(pairs, before, expected, pairs.by_engine(before, 160.0));
  verification::Comparison c{
      .group = "particles",
      .name = std::string("two spinning ") + (spheres ? "spheres" : "discs") + ", one five times as large",
      .quantity = "largest error of any velocity (rim speeds of the spins included), over the impact's own, t_e/10",
      .unit = "",
      .reference = "ODE integration of (2.1), (2.2), Runge-Kutta of fourth order, t_e/4000",
      .origin = "plan of Chung and Ooi 2011, test 8; the scenes' e = 0.7, mu = 0.7",
      .expected = 0.0,
      .found = at_10,
      .tolerance = 0.12,
      .reason =
          "discretisation, first order: the spring takes the whole step's slip, here up to 1.4 times the impact's "
          "own velocity, wherever in it the touch began"};
  verification::check(c);
  c.quantity = "the same at t_e/160";
  c.found = at_160;
  c.tolerance = 0.12 / 16.0;
  verification::check(c);
  c.quantity = "order of that error in the step";
  c.expected = 1.0;
  c.found = std::log2(at_10 / at_160) / 4.0;
  c.tolerance = 0.1;
  c.reason = "discretisation: higher order";
  verification::check(c);
}

TEST(UnequalSpin, Discs) { check(false); }
TEST(UnequalSpin, Spheres) { check(true); }

}  // namespace
}  // namespace grainstep::dem
