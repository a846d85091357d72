/// @file The common end of every engine: contact with the surface attached to what LAMMPS holds, and all windows run.
#pragma once

#include "dem-service/lammps/session.hpp"
#include "dem-service/slug/model.hpp"
#include "dem-service/slug/step_driver.hpp"

namespace grainstep::dem {

struct Attached {
  LammpsSession& session;
  MPI_Comm communicator;
  const SlugModel& model;
  const wire::Surface& surface;
  StepSettings settings;
  bool own_pair_style = true;
};

/// InputError for a run that has more steps than LAMMPS counts.
void require_drivable(const wire::Start& start);

/// InputError for a run that is to go on: LAMMPS scripts of one's own have states that nobody else knows.
void require_beginning(const wire::Start& start);

/// Collective. `link`: rank 0's, nullptr elsewhere.
void drive(const Attached& what, const wire::Start& start, participant::ImpactorLink* link);

}  // namespace grainstep::dem
