#include "fe-service/windows.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "fe-service/deformable.hpp"
#include "fe-service/rigid.hpp"
#include "fe-service/solid.hpp"

namespace grainstep::fe {

std::unique_ptr<WindowedStructure> make_structure(const wire::Setup& setup, base::Team* team) {
  if (!setup.has_structure()) throw InputError("setup: grainstep-fe is a structure, but was sent an impactor's part");
  const Measure measure = make_measure(setup.symmetry(), setup.depth());
  const scene::Structure& structure = setup.structure().structure();
  check_measure(structure, measure);
  switch (structure.type()) {
    case scene::Structure::TYPE_BEAM:
    case scene::Structure::TYPE_PLATE:
      return std::make_unique<Deformable>(structure, setup.structure().guards(), measure, team);
    case scene::Structure::TYPE_RIGID:
      return std::make_unique<Rigid>(structure, measure);
    default:
      throw InputError(
          fmt::format("structure.type: grainstep-fe knows `beam`, `plate` and `rigid`, found value number {}",
                      static_cast<int>(structure.type())));
  }
}

void check_forces(const wire::Forces& forces, std::size_t nodes) {
  if (forces.impulse_size() != static_cast<int>(2 * nodes)) {
    throw PeerError("impactor", fmt::format("Forces of window {} hold {} numbers, expected {} (2 for each of {} nodes)",
                                            forces.window(), forces.impulse_size(), 2 * nodes, nodes));
  }
  for (int i = 0; i < forces.impulse_size(); ++i) {
    if (std::isfinite(forces.impulse(i))) continue;
    throw NumericalError(fmt::format("not a number: impulse {} on surface node {} in window {}, from the impactor",
                                     forces.impulse(i), i / 2, forces.window()));
  }
}

void add_observable(wire::Report& report, const char* name, const char* unit, double value) {
  wire::Observable& observable = *report.add_observable();
  observable.set_name(name);
  observable.set_unit(unit);
  observable.set_value(value);
}

}  // namespace grainstep::fe
