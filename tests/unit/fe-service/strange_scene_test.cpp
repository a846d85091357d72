/// @file Scenes that no loader has read: a participant's part of one comes over the wire, from whoever is there. What
/// cannot be computed is an InputError that names the key, before memory is taken for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../../support/fe_scenes.hpp"
#include "base/error.hpp"
#include "base/physical_memory.hpp"
#include "fe-service/impactor.hpp"
#include "fe-service/load/loaded_patch.hpp"
#include "fe-service/mesh.hpp"
#include "fe-service/structure.hpp"

namespace grainstep::fe {
namespace {

using testing::HasSubstr;

template <class Backend>
std::string refusal_of(Backend& backend, const wire::Setup& setup) {
  try {
    static_cast<void>(backend.prepare(setup));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string refusal_of_structure(const std::function<void(wire::Setup&)>& change) {
  wire::Setup setup = test::setup_of(test::beam(scene::Layer::MATERIAL_DH36, 0.1, 0.02, 3));
  change(setup);
  Structure structure;
  return refusal_of(structure, setup);
}

scene::Structure& structure_in(wire::Setup& setup) { return *setup.mutable_structure()->mutable_structure(); }

TEST(StrangeScene, ANumberOutOfItsKeysRangeIsRefused) {
  const struct {
    const char* told;
    std::function<void(wire::Setup&)> change;
  } cases[] = {{"no error", [](wire::Setup&) {}},
               {"depth: found -1 m", [](wire::Setup& s) { s.set_depth(-1.0); }},
               {"depth: found nan m", [](wire::Setup& s) { s.set_depth(std::nan("")); }},
               {"structure.half_span: found inf", [](wire::Setup& s) { structure_in(s).set_half_span(HUGE_VAL); }},
               {"structure.mesh.refinement: found 0, expected a number above 0",
                [](wire::Setup& s) { structure_in(s).mutable_mesh()->set_refinement(0.0); }},
               {"structure.layers.0.thickness: found nan, expected a number above 0, in m",
                [](wire::Setup& s) { structure_in(s).mutable_layers(0)->set_thickness(std::nan("")); }},
               {"structure.layers.0.poisson: found 0.5, expected a number above -1, below 0.5",
                [](wire::Setup& s) { structure_in(s).mutable_layers(0)->set_poisson(0.5); }},
               {"structure.layers: none given", [](wire::Setup& s) { structure_in(s).clear_layers(); }},
               {"structure.bulk_viscosity.linear: found -1",
                [](wire::Setup& s) { structure_in(s).mutable_bulk_viscosity()->set_linear(-1.0); }},
               {"guards.element_quality: found 1",
                [](wire::Setup& s) { s.mutable_structure()->mutable_guards()->set_element_quality(1.0); }}};
  for (const auto& one : cases) EXPECT_THAT(refusal_of_structure(one.change), HasSubstr(one.told));
}

TEST(StrangeScene, AMeshBeyondAllMemoryIsRefused) {
  EXPECT_THAT(refusal_of_structure([](wire::Setup& s) { structure_in(s).set_half_span(1e9); }),
              HasSubstr("structure.mesh.refinement: 3 gives 3e+11 x 6 elements"));
  EXPECT_NO_THROW(require_fits(1e3, "structure.mesh.refinement"));
  EXPECT_THROW(require_fits(std::nan(""), "structure.mesh.refinement"), InputError);
  const double too_many = physical_memory() / 100.0;  // a quad takes some hundred bytes
  EXPECT_THROW(require_fits(too_many, "structure.mesh.refinement"), InputError) << too_many;
}

std::string refusal_of_impactor(const scene::Impactor& impactor) {
  wire::Setup setup;
  setup.set_symmetry(scene::SYMMETRY_PLANE_STRAIN);
  setup.set_depth(1e-3);
  setup.set_dimension(2);
  *setup.mutable_impactor()->mutable_impactor() = impactor;
  wire::Surface& surface = *setup.mutable_impactor()->mutable_surface();
  surface.set_dimension(2);
  for (const double x : {0.0, 0.0, 1.0, 0.0}) {
    surface.add_position(x);
    surface.add_velocity(0.0);
  }
  surface.add_facet(0);
  surface.add_facet(1);
  Impactor backend;
  return refusal_of(backend, setup);
}

TEST(StrangeScene, APressureWithoutAHistoryIsRefused) {
  scene::Impactor impactor;
  impactor.set_type(scene::Impactor::TYPE_PRESSURE);
  EXPECT_THAT(refusal_of_impactor(impactor), HasSubstr("impactor.pressure: needs a history"));
  scene::TabulatedPulse& table = *impactor.mutable_pressure()->mutable_tabulated();
  for (const double time : {0.0, 1.0, 2.0}) table.add_time(time);
  table.add_pressure(1e6);
  EXPECT_THAT(refusal_of_impactor(impactor), HasSubstr("1 pressures for 3 times; expected one for each"));
  table.add_pressure(1e6);
  table.add_pressure(1e6);
  EXPECT_EQ(refusal_of_impactor(impactor), "no error");
  table.set_time(2, 1.0);
  EXPECT_THAT(refusal_of_impactor(impactor), HasSubstr("tabulated.time.2: times must increase strictly"));
  table.set_time(2, std::nan(""));
  EXPECT_THAT(refusal_of_impactor(impactor), HasSubstr("impactor.pressure.tabulated.time.2: found nan"));
}

// Twice this node number is small again in 32 bits.
TEST(StrangeScene, APatchOnANodeThatIsNotThereIsRefused) {
  wire::Surface surface;
  surface.set_dimension(2);
  for (const double x : {0.0, 0.0, 1.0, 0.0}) surface.add_position(x);
  surface.add_facet(0);
  surface.add_facet(0x80000001U);
  EXPECT_THROW(LoadedPatch(surface, scene::Pressure()), InputError);
}

TEST(StrangeScene, AFoamOfMoreElementsThanMemoryIsRefused) {
  scene::Impactor impactor;
  impactor.set_type(scene::Impactor::TYPE_FOAM);
  scene::Slug& slug = *impactor.mutable_slug();
  slug.set_half_width(1e9);
  slug.set_height(1e-3);
  slug.set_relative_density(0.2);
  slug.set_speed(400.0);
  slug.set_slice_angle(0.1);
  scene::Particle& particle = *slug.mutable_particle();
  particle.set_diameter(1e-4);
  particle.set_density(2700.0);
  particle.set_normal_stiffness(7.3e6);
  particle.set_restitution(0.7);
  scene::Foam& foam = *impactor.mutable_foam();
  foam.set_elements(10000);
  foam.set_strength(0.01);
  foam.set_shock_width(0.03);
  foam.set_contact_stiffness(1.0);
  EXPECT_THAT(refusal_of_impactor(impactor), HasSubstr("impactor.foam.elements: 10000 over the height gives 1e+16"));
  foam.set_elements(0);
  EXPECT_THAT(refusal_of_impactor(impactor),
              HasSubstr("impactor.foam.elements: found 0, expected a number at least 4"));
}

}  // namespace
}  // namespace grainstep::fe
