#include "dem-service/deck/deck_model.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "participant/hello.hpp"

namespace grainstep::dem {

void require_deck_scene(const wire::Setup& setup) {
  if (setup.symmetry() != scene::SYMMETRY_PLANE_STRAIN || setup.mirror()) {
    throw InputError(
        "impactor.deck: scripts load structures in plane strain without a mirror plane; write structure.extent: "
        "full");
  }
}

SlugModel make_deck_model(const scene::DeckContact& contact, const DeckParticles& particles) {
  if (particles.count == 0) throw InputError("impactor.deck: the script makes no particles before its first run");
  if (!(particles.smallest > 0.0)) {
    throw InputError("impactor.deck: the script's particles are points; atom_style sphere gives them a radius");
  }
  if (particles.dimension != 2) {
    throw InputError(
        "impactor.deck: the script has dimension 3, the structure's surface is one of two dimensions; write "
        "`dimension 2` into the script");
  }
  const double kn = contact.normal_stiffness();
  SlugModel model;
  model.diameter = particles.largest;
  model.sizes = scene::Sizes::between(particles.smallest / particles.largest, 1.0);
  model.particles = particles.count;
  model.fixed_number = false;  // the script may pour in more, or take some away
  model.mass = particles.mass / static_cast<double>(particles.count);
  model.surface_law = {kn, kn * contact.tangential_ratio(), 0.0, contact.friction(), false};
  model.on_surface = {kn, particles.lightest, contact.restitution(), false};
  model.heaviest = particles.heaviest;
  model.contact_time = contact_time(model.on_surface);
  model.stable_step = model.preferred_step = particles.step;
  return model;
}

wire::Ready ready_of(const SlugModel& model, const DeckParticles& particles) {
  wire::Ready out;
  out.set_size(particles.count);
  out.set_counted("particles");
  out.set_ledger(particles.own_pair_style ? wire::FULL : wire::INTERFACE);
  out.set_mass(particles.mass);
  out.set_contact_mass(particles.heaviest);
  out.set_contact_time(model.contact_time);
  out.set_stable_step(model.stable_step);
  out.set_preferred_step(model.preferred_step);
  out.set_largest_particle(particles.largest);
  participant::add_fact(out, "particles",
                        fmt::format("{}, {:.4g} to {:.4g} mm, of a script with a timestep of {:.4g} s", particles.count,
                                    1e3 * particles.smallest, 1e3 * particles.largest, particles.step));
  return out;
}

}  // namespace grainstep::dem
