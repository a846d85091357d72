#include "dem-service/slug/report.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace grainstep::dem {
namespace {

template <typename Doubles>
constexpr int count_of = static_cast<int>(sizeof(Doubles) / sizeof(double));

template <typename Doubles>
double* values_of(Doubles& all) {
  static_assert(sizeof(Doubles) % sizeof(double) == 0);
  return reinterpret_cast<double*>(&all);
}

void observe(wire::Report& report, const char* name, const char* unit, double value) {
  wire::Observable& observable = *report.add_observable();
  observable.set_name(name);
  observable.set_unit(unit);
  observable.set_value(value);
}

}  // namespace

std::optional<std::string> DissipationGuard::look(const wire::Energy& energy) {
  kinetic_ = std::max(kinetic_, energy.kinetic());
  elastic_ = std::max(elastic_, energy.elastic());
  damping_ = std::max(damping_, energy.damping());
  friction_ = std::max(friction_, energy.friction());
  const double fall = std::max(damping_ - energy.damping(), friction_ - energy.friction());
  if (!(fall > 1e-3 * kinetic_ + 0.1 * elastic_)) return std::nullopt;
  std::ostringstream text;
  text << "what contacts have dissipated fell by " << fall << " J, of " << kinetic_
       << " J at most in motion, but can only grow: the contact forces are wrong or the steps too coarse; lower "
          "steps.impactor";
  return text.str();
}

namespace {

double squared(const double* a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

}  // namespace

void add_particles(const SlugModel& model, const ParticleArrays& particles, ReportSums& sums, ReportMaxima& maxima) {
  sums.particles += particles.owned;
  const contact::Shape shape = model.spheres() ? contact::Shape::revolved : contact::Shape::extruded;
  double fastest = 0.0;
  for (int i = 0; i < particles.owned; ++i) {
    const double* v = particles.velocity[i];
    const double mass = particles.mass[i];
    const double speed2 = squared(v);
    const double inertia = model.gyration() * mass * particles.radius[i] * particles.radius[i];
    sums.kinetic += 0.5 * (mass * speed2 + inertia * squared(particles.spin[i]));
    for (int c = 0; c < 3; ++c) sums.momentum[c] += mass * v[c];
    fastest = std::max(fastest, speed2);
    const surface::Vec2 x = contact::place_of(shape, particles.position[i]);
    maxima.spread = std::max(maxima.spread, x[0]);
    maxima.top = std::max(maxima.top, x[1]);
  }
  maxima.speed = std::max(maxima.speed, std::sqrt(fastest));
}

ReportSums summed(ReportSums sums, const Exchange& exchange) {
  exchange.sum(values_of(sums), count_of<ReportSums>);
  return sums;
}

ReportMaxima largest(ReportMaxima maxima, const Exchange& exchange) {
  exchange.largest(values_of(maxima), count_of<ReportMaxima>);
  return maxima;
}

namespace {

void fill_momentum(const SlugModel& model, const ReportSums& sums, wire::Momentum& momentum) {
  const double whole = model.whole();
  const contact::Meridian middle{std::cos(0.5 * model.slice), std::sin(0.5 * model.slice)};
  const auto in_plane = [&](const double* a) { return middle.in_plane({{a[0], a[1], a[2]}}); };
  const surface::Vec2 linear = in_plane(sums.momentum);
  const surface::Vec2 surface = in_plane(sums.surface_impulse);
  const surface::Vec2 planes = in_plane(sums.plane_impulse);
  // Along r the surface gets each force's own radial component; the slice's middle radius turns away from it. The
  // difference is what the neighbouring slices would give, like the planes' share.
  const double received = model.spheres() ? sums.radial : surface[0];
  momentum.add_linear(whole * linear[0]);
  momentum.add_interface_impulse(whole * received);
  momentum.add_support_impulse(whole * (planes[0] + (surface[0] - received)));
  momentum.add_linear(whole * linear[1]);
  momentum.add_interface_impulse(whole * surface[1]);
  momentum.add_support_impulse(whole * planes[1]);
}

void observe_rings(const SlugModel& model, const ReportSums& sums, wire::Report& report) {
  observe(report, "circumferential_share", "", sums.size > 0.0 ? sums.around / sums.size : 0.0);
  observe(report, "circumferential_impulse", "N s", model.whole() * sums.around);
  observe(report, "circumferential_work", "J", model.whole() * sums.around_work);
}

}  // namespace

void fill_report(const SlugModel& model, const ReportSums& sums, const ReportMaxima& maxima, wire::Report& report) {
  const double whole = model.whole();
  const double tangential_stored = sums.pair_tangential + sums.surface_tangential;
  wire::Energy& energy = *report.mutable_energy();
  energy.set_kinetic(whole * sums.kinetic);
  energy.set_elastic(whole * (sums.pair_normal + sums.surface_normal + sums.plane_stored + tangential_stored));
  energy.set_damping(whole * (sums.pair_damping + sums.surface_damping + sums.plane_damping));
  energy.set_friction(whole * (sums.pair_work_tangential + sums.surface_work_tangential - tangential_stored));
  // The springs and dashpots of the contact are on this side of the interface: what the surface does to this side is
  // minus what is done to the surface. Mirror and walls do no work at all: their springs and dashpots are the
  // particles' own.
  energy.set_interface_work(-whole * sums.work_on_surface);
  fill_momentum(model, sums, *report.mutable_momentum());
  observe(report, "max_overlap", "", maxima.overlap);
  observe(report, "max_particle_speed", "m/s", maxima.speed);
  observe(report, "slug_top", "m", maxima.top);
  observe(report, "slug_spread", "m", maxima.spread);
  observe(report, "contacts_with_surface", "", sums.surface_contacts);
  observe(report, "work_on_surface", "J", whole * sums.work_on_surface);
  observe(report, "work_on_particles", "J", whole * sums.work_on_particles);
  if (model.spheres()) observe_rings(model, sums, report);
}

namespace {

constexpr int snapshot_values = 11;  // identity, radius, position, velocity, spin

wire::Field& field(wire::Snapshot& snapshot, const char* name, const char* unit, unsigned components) {
  wire::Field& added = *snapshot.add_point_field();
  added.set_name(name);
  added.set_unit(unit);
  added.set_components(components);
  return added;
}

}  // namespace

void gather_snapshot(const SlugModel& model, const ParticleArrays& particles, const Exchange& exchange,
                     wire::Snapshot& snapshot) {
  std::vector<double> mine;
  mine.reserve(static_cast<std::size_t>(snapshot_values) * static_cast<std::size_t>(particles.owned));
  for (int i = 0; i < particles.owned; ++i) {
    mine.insert(mine.end(), {static_cast<double>(particles.identity[i]), particles.radius[i]});
    for (const double* a : {particles.position[i], particles.velocity[i], particles.spin[i]}) {
      mine.insert(mine.end(), a, a + 3);
    }
  }
  const std::vector<double> all = exchange.gathered(std::move(mine));
  std::vector<const double*> rows;
  for (std::size_t i = 0; i < all.size(); i += snapshot_values) rows.push_back(&all[i]);
  std::sort(rows.begin(), rows.end(), [](const double* a, const double* b) { return a[0] < b[0]; });
  const int dimension = model.spheres() ? 3 : 2;
  snapshot.set_dimension(static_cast<unsigned>(dimension));
  wire::Field& radius = field(snapshot, "radius", "m", 1);
  wire::Field& velocity = field(snapshot, "velocity", "m/s", snapshot.dimension());
  wire::Field& spin = field(snapshot, "angular_velocity", "1/s", model.spheres() ? 3 : 1);
  wire::Field& identity = field(snapshot, "identity", "", 1);
  for (const double* row : rows) {
    identity.add_value(row[0]);
    radius.add_value(row[1]);
    for (int c = 0; c < dimension; ++c) snapshot.add_position(row[2 + c]);
    for (int c = 0; c < dimension; ++c) velocity.add_value(row[5 + c]);
    for (int c = model.spheres() ? 0 : 2; c < 3; ++c) spin.add_value(row[8 + c]);
  }
}

}  // namespace grainstep::dem
