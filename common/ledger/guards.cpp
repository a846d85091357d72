#include "ledger/guards.hpp"

#include <sstream>
#include <vector>

namespace grainstep::ledger {
namespace {

struct Limit {
  const char* key;
  double found;
  double allowed;
  bool broken;
  const char* meaning;
};

std::string text_of(const Limit& limit) {
  std::ostringstream out;
  out << "guards." << limit.key << ": found " << limit.found << ", allowed " << limit.allowed << ". " << limit.meaning;
  return out.str();
}

}  // namespace

std::optional<std::string> violation(const scene::Guards& guards, const Guarded& guarded) {
  const Balance& b = guarded.balance;
  const bool foam = guarded.impactor == scene::Impactor::TYPE_FOAM;
  std::vector<Limit> limits = {
      {"energy_drift", b.energy_drift, guards.energy_drift(), !(b.energy_drift <= guards.energy_drift()),
       foam
           ? "Energy was made or lost by the integration itself. If it falls with the steps, take smaller ones "
             "(steps.impactor, steps.structure); if not, the foam's contact is too soft or its shock too narrow for "
             "its "
             "mesh: raise impactor.foam.contact_stiffness, or impactor.foam.shock_width to two elements or more."
           : "Energy was made or lost by the integration itself: a step is too large for the contacts or the elements. "
             "Take a smaller steps.impactor (a larger ratio) or steps.structure, or raise the guard if the loss is "
             "acceptable."},
      {"momentum_error", b.momentum_error, guards.momentum_error(), !(b.momentum_error <= guards.momentum_error()),
       "One side did not receive what the other gave: a participant is at fault, not the scene. Compare the sides' own "
       "closure in results.h5 under /ledger."}};
  if (guarded.overlap) {
    limits.push_back(
        {"overlap", *guarded.overlap, guards.overlap(), !(*guarded.overlap <= guards.overlap()),
         foam ? "The foam's nodes pass into the structure by that part of their contact's diameter, half an "
                "element: the contact is too soft for this speed. Raise impactor.foam.contact_stiffness."
              : "Particles pass into each other or into the structure by that part of a diameter: the contact is "
                "too soft for this speed. Raise particle.normal_stiffness."});
  }
  if (guarded.element_quality) {
    limits.push_back(
        {"element_quality", *guarded.element_quality, guards.element_quality(),
         !(*guarded.element_quality >= guards.element_quality()),
         "An element has collapsed to that part of its area: the mesh is too distorted to go on. Refine it "
         "(structure.mesh.refinement) or reduce the load."});
  }
  for (const Limit& limit : limits) {
    if (limit.broken) {
      return text_of(limit);
    }
  }
  return std::nullopt;
}

}  // namespace grainstep::ledger
