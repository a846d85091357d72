#include "fe-service/structure.hpp"

#include <unistd.h>

#include "base/assert.hpp"
#include "fe-service/kernel/kernel.hpp"
#include "fe-service/materials/material.hpp"

namespace grainstep::fe {

wire::Hello Structure::describe() const {
  wire::Hello hello;
  hello.set_protocol(wire::PROTOCOL_VERSION);
  hello.set_role(wire::STRUCTURE);
  hello.set_backend(std::string("grainstep-fe (") + available_kernels().front()->name + ")");
  hello.set_version(GRAINSTEP_VERSION);
  hello.set_dimension(2);
  for (const char* capability : {"beam", "plate", "rigid", "plane_strain", "axisymmetric"})
    hello.add_capabilities(capability);
  for (const std::string& material : layer_words()) hello.add_capabilities(material);
  hello.set_process(static_cast<std::uint64_t>(getpid()));
  return hello;
}

wire::Ready Structure::prepare(const wire::Setup& setup) {
  structure_ = make_structure(setup);
  wire::Ready ready;
  ready.set_scene_hash(setup.scene_hash());
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
