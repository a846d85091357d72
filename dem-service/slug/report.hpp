/// @file A slug's Report and Snapshot, of all processes that share it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/surface_contacts.hpp"
#include "dem-service/law/pair_energy.hpp"
#include "dem-service/law/plane_contacts.hpp"
#include "dem-service/slug/exchange.hpp"
#include "dem-service/slug/model.hpp"
#include "grainstep/wire.pb.h"

namespace grainstep::dem {

using contact::SurfaceContacts;
using contact::SurfaceContactSettings;

/// One rank's share of everything a report adds up. All doubles: reduced as one array.
struct ReportSums {
  double particles = 0.0;
  double kinetic = 0.0;
  double pair_normal = 0.0, pair_tangential = 0.0;  ///< J, stored
  double pair_damping = 0.0, pair_work_tangential = 0.0;
  double surface_normal = 0.0, surface_tangential = 0.0, plane_stored = 0.0;
  double surface_damping = 0.0, surface_work_tangential = 0.0, plane_damping = 0.0;
  double work_on_particles = 0.0, work_on_surface = 0.0;
  double momentum[3] = {0.0, 0.0, 0.0};
  double surface_impulse[3] = {0.0, 0.0, 0.0};
  double plane_impulse[3] = {0.0, 0.0, 0.0};
  double surface_contacts = 0.0;
  double radial = 0.0, size = 0.0, around = 0.0, around_work = 0.0;  ///< as contact::InterfaceLedger has them
};

struct ReportMaxima {
  double overlap = 0.0;
  double speed = 0.0;
  double top = -1e300;     ///< m, highest centre
  double spread = -1e300;  ///< m, largest x1 (spheres: distance from the axis) of a centre
};

/// What is dissipated is gone: it may only grow. The energy balance cannot see that, because dissipation is measured
/// from whatever force acted; a torque of the wrong sign or a slider without its limit shows here.
class DissipationGuard {
 public:
  /// Rank 0's report. Text where damping or friction fell by more than a thousandth of the largest kinetic energy and a
  /// tenth of what contacts stored: while a contact lasts, its ledger is off by a few percent of what it stores.
  [[nodiscard]] std::optional<std::string> look(const wire::Energy& energy);

 private:
  double kinetic_ = 0.0, elastic_ = 0.0, damping_ = 0.0, friction_ = 0.0;  ///< J, largest so far
};

/// Kinetic energy, momentum, extent: what needs only the particles. Velocities at t(n).
void add_particles(const SlugModel& model, const ParticleArrays& particles, ReportSums& sums, ReportMaxima& maxima);

/// Over all processes; the result counts on the root.
[[nodiscard]] ReportSums summed(ReportSums sums, const Exchange& exchange);
[[nodiscard]] ReportMaxima largest(ReportMaxima maxima, const Exchange& exchange);

/// Of a slice: everything that is a sum, times the full circle over the slice. docs/theory/step.md has what is reported
/// as momentum along r.
void fill_report(const SlugModel& model, const ReportSums& sums, const ReportMaxima& maxima, wire::Report& report);

/// Filled on the root, in the order of identities, so that it does not depend on the number of processes.
void gather_snapshot(const SlugModel& model, const ParticleArrays& particles, const Exchange& exchange,
                     wire::Snapshot& snapshot);

}  // namespace grainstep::dem
