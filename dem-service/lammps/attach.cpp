#include "dem-service/lammps/attach.hpp"

#include <limits>
#include <string>

#include "base/error.hpp"
#include "dem-service/lammps/adapter.hpp"
#include "dem-service/lammps/rank_exchange.hpp"
#include "dem-service/lammps/surface_fix.hpp"

namespace grainstep::dem {

void require_drivable(const wire::Start& start) {
  if (start.first_window() != 0) throw InputError("grainstep-dem cannot continue a run: Start.first_window must be 0");
  if (!(start.window() > 0.0) || start.impactor_steps() == 0) {
    throw InputError("Start: window and impactor_steps must be above 0");
  }
  const std::uint64_t steps = start.windows() * start.impactor_steps();
  if (steps > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
    throw InputError("time.end: " + std::to_string(steps) + " steps, but LAMMPS counts up to 2^31: end earlier");
  }
}

void drive(const Attached& what, const wire::Start& start, participant::ImpactorLink* link) {
  require_drivable(start);
  const std::uint64_t steps = start.windows() * start.impactor_steps();
  MovingSurface surface(what.surface);
  RankExchange exchange(what.communicator, link, surface.node_count());
  StepDriver driver(what.model, start, what.settings, std::move(surface), exchange);
  lammps::register_fix<SurfaceFix>(what.session.lammps());
  what.session.command("fix surface all grainstep/surface");
  lammps::find_fix<SurfaceFix>(what.session.lammps(), "surface").connect(driver, exchange, what.own_pair_style);
  what.session.command("run " + std::to_string(steps) + " post no");
  exchange.finish();
}

}  // namespace grainstep::dem
