#include "dem-service/lammps/attach.hpp"

#include <limits>
#include <string>

#include "base/error.hpp"
#include "dem-service/lammps/adapter.hpp"
#include "dem-service/lammps/rank_exchange.hpp"
#include "dem-service/lammps/surface_fix.hpp"
#include "participant/resumed.hpp"

namespace grainstep::dem {

void require_drivable(const wire::Start& start) {
  if (!(start.window() > 0.0) || start.impactor_steps() == 0) {
    throw InputError("Start: window and impactor_steps must be above 0");
  }
  const std::uint64_t steps = start.windows() * start.impactor_steps();
  if (steps > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
    throw InputError("time.end: " + std::to_string(steps) + " steps, but LAMMPS counts up to 2^31: end earlier");
  }
}

void require_beginning(const wire::Start& start) {
  if (start.first_window() == 0) return;
  throw InputError("a LAMMPS script cannot be resumed: Start.first_window is " + std::to_string(start.first_window()) +
                   ", expected 0");
}

void drive(const Attached& what, const wire::Start& start, participant::ImpactorLink* link) {
  require_drivable(start);
  const std::uint64_t steps = start.windows() * start.impactor_steps();
  MovingSurface surface(what.surface);
  RankExchange exchange(what.communicator, link, surface.node_count());
  StepDriver driver(what.model, start, what.settings, std::move(surface), exchange);
  lammps::register_fix<SurfaceFix>(what.session.lammps());
  what.session.command("fix surface all grainstep/surface");
  auto& fix = lammps::find_fix<SurfaceFix>(what.session.lammps(), "surface");
  fix.connect(driver, exchange, what.own_pair_style);
  if (const auto resumed = link == nullptr ? std::nullopt : participant::resumed(start, *link)) {
    fix.wait();
    what.session.command("run 0 post no");
    fix.go_on_from(resumed->state);
    const std::uint64_t left = steps - resumed->window * start.impactor_steps();
    what.session.command("run " + std::to_string(left) + " pre no post no");
  } else {
    what.session.command("run " + std::to_string(steps) + " post no");
  }
  exchange.finish();
}

}  // namespace grainstep::dem
