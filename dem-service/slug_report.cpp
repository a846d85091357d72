#include "dem-service/slug_report.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace grainstep::dem {
namespace {

template <typename Doubles>
Doubles reduced(const Doubles& mine, MPI_Op operation, MPI_Comm communicator) {
  static_assert(sizeof(Doubles) % sizeof(double) == 0);
  Doubles all = mine;
  MPI_Reduce(&mine, &all, static_cast<int>(sizeof(Doubles) / sizeof(double)), MPI_DOUBLE, operation, 0, communicator);
  return all;
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

void add_particles(const ParticleArrays& particles, ReportSums& sums, ReportMaxima& maxima) {
  sums.particles += particles.owned;
  double fastest = 0.0;
  for (int i = 0; i < particles.owned; ++i) {
    const double* x = particles.position[i];
    const double* v = particles.velocity[i];
    const double mass = particles.mass[i];
    const double speed2 = v[0] * v[0] + v[1] * v[1];
    const double inertia = 0.5 * mass * particles.radius[i] * particles.radius[i];  // cylinder: m D^2/8
    const double spin = particles.spin[i][2];
    sums.kinetic += 0.5 * (mass * speed2 + inertia * spin * spin);
    for (int c = 0; c < 2; ++c) sums.momentum[c] += mass * v[c];
    fastest = std::max(fastest, speed2);
    maxima.spread = std::max(maxima.spread, x[0]);
    maxima.top = std::max(maxima.top, x[1]);
  }
  maxima.speed = std::max(maxima.speed, std::sqrt(fastest));
}

ReportSums summed(const ReportSums& sums, MPI_Comm communicator) { return reduced(sums, MPI_SUM, communicator); }

ReportMaxima largest(const ReportMaxima& maxima, MPI_Comm communicator) {
  return reduced(maxima, MPI_MAX, communicator);
}

void fill_report(const ReportSums& sums, const ReportMaxima& maxima, wire::Report& report) {
  const double tangential_stored = sums.pair_tangential + sums.surface_tangential;
  wire::Energy& energy = *report.mutable_energy();
  energy.set_kinetic(sums.kinetic);
  energy.set_elastic(sums.pair_normal + sums.surface_normal + sums.plane_stored + tangential_stored);
  energy.set_damping(sums.pair_damping + sums.surface_damping + sums.plane_damping);
  energy.set_friction(sums.pair_work_tangential + sums.surface_work_tangential - tangential_stored);
  // The springs and dashpots of the contact are on this side of the interface: what the surface does to this side is
  // minus what is done to the surface. Mirror and walls do no work at all: their springs and dashpots are the
  // particles' own.
  energy.set_interface_work(-sums.work_on_surface);
  wire::Momentum& momentum = *report.mutable_momentum();
  for (int c = 0; c < 2; ++c) {
    momentum.add_linear(sums.momentum[c]);
    momentum.add_interface_impulse(sums.surface_impulse[c]);
    momentum.add_support_impulse(sums.plane_impulse[c]);
  }
  observe(report, "max_overlap", "", maxima.overlap);
  observe(report, "max_particle_speed", "m/s", maxima.speed);
  observe(report, "slug_top", "m", maxima.top);
  observe(report, "slug_spread", "m", maxima.spread);
  observe(report, "contacts_with_surface", "", sums.surface_contacts);
  observe(report, "work_on_surface", "J", sums.work_on_surface);
  observe(report, "work_on_particles", "J", sums.work_on_particles);
}

namespace {

constexpr int snapshot_values = 7;  // identity, x1, x2, v1, v2, spin, radius

std::vector<double> gathered(const std::vector<double>& mine, MPI_Comm communicator) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  const int count = static_cast<int>(mine.size());
  std::vector<int> counts(static_cast<std::size_t>(ranks));
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator);
  std::vector<int> offsets;
  int total = 0;
  for (const int of_rank : counts) {
    offsets.push_back(total);
    total += of_rank;
  }
  std::vector<double> all(static_cast<std::size_t>(total));
  MPI_Gatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE, 0, communicator);
  return all;
}

wire::Field& field(wire::Snapshot& snapshot, const char* name, const char* unit, unsigned components) {
  wire::Field& added = *snapshot.add_point_field();
  added.set_name(name);
  added.set_unit(unit);
  added.set_components(components);
  return added;
}

}  // namespace

void gather_snapshot(const ParticleArrays& particles, MPI_Comm communicator, wire::Snapshot& snapshot) {
  std::vector<double> mine;
  mine.reserve(static_cast<std::size_t>(snapshot_values * particles.owned));
  for (int i = 0; i < particles.owned; ++i) {
    const double* x = particles.position[i];
    const double* v = particles.velocity[i];
    mine.insert(mine.end(), {static_cast<double>(particles.identity[i]), x[0], x[1], v[0], v[1], particles.spin[i][2],
                             particles.radius[i]});
  }
  const std::vector<double> all = gathered(mine, communicator);
  std::vector<const double*> rows;
  for (std::size_t i = 0; i < all.size(); i += snapshot_values) rows.push_back(&all[i]);
  std::sort(rows.begin(), rows.end(), [](const double* a, const double* b) { return a[0] < b[0]; });
  wire::Field& radius = field(snapshot, "radius", "m", 1);
  wire::Field& velocity = field(snapshot, "velocity", "m/s", 2);
  wire::Field& spin = field(snapshot, "angular_velocity", "1/s", 1);
  wire::Field& identity = field(snapshot, "identity", "", 1);
  for (const double* row : rows) {
    identity.add_value(row[0]);
    snapshot.add_position(row[1]);
    snapshot.add_position(row[2]);
    velocity.add_value(row[3]);
    velocity.add_value(row[4]);
    spin.add_value(row[5]);
    radius.add_value(row[6]);
  }
}

}  // namespace grainstep::dem
