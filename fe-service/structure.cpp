#include "fe-service/structure.hpp"

#include "base/assert.hpp"
#include "base/error.hpp"
#include "declare/ranges.hpp"
#include "fe-service/kernel/kernel.hpp"
#include "fe-service/materials/material.hpp"
#include "fe-service/preview.hpp"
#include "participant/hello.hpp"

namespace grainstep::fe {

wire::Hello Structure::describe() const {
  wire::Hello hello = participant::hello(
      wire::STRUCTURE, std::string("grainstep-fe (") + available_kernels().front()->name + ")", GRAINSTEP_VERSION, {2});
  for (const char* capability : {"beam", "plate", "rigid", "plane_strain", "axisymmetric", "initial_velocity",
                                 "bulk_viscosity", "threads", "state"})
    hello.add_capabilities(capability);
  for (const std::string& material : layer_words()) hello.add_capabilities(material);
  return hello;
}

// What a preview finds is what check_measure() and the mesh would refuse in a run as well, before memory is taken.
wire::Ready Structure::prepare(const wire::Setup& setup) {
  if (!setup.has_structure()) throw InputError("setup: grainstep-fe is a structure, but was sent an impactor's part");
  declare::require_ranges(setup.structure().structure(), "structure");
  if (setup.structure().has_guards()) declare::require_ranges(setup.structure().guards(), "guards");
  const StructurePreview found = preview(setup.structure().structure(), setup.symmetry(), setup.depth());
  wire::Ready ready = found.ready();
  ready.set_scene_hash(setup.scene_hash());
  if (setup.preview()) return ready;
  if (threads_ > 1) team_.emplace(threads_);
  structure_ = make_structure(setup, team_ ? &*team_ : nullptr);
  ready.clear_surface();
  structure_->fill_ready(ready);
  return ready;
}

WindowedStructure& Structure::prepared() {
  GS_ASSERT(structure_ != nullptr, "called before prepare()");
  return *structure_;
}

void Structure::start(const wire::Start& start) { prepared().start(start); }
void Structure::advance(const wire::Forces& forces, participant::Due due, wire::Kinematics& next) {
  prepared().advance(forces, due, next);
}
void Structure::report(wire::Report& report) { prepared().report(report); }
void Structure::snapshot(wire::Snapshot& snapshot) { prepared().snapshot(snapshot); }
void Structure::complete() { prepared().complete(); }

}  // namespace grainstep::fe
