/// @file The slug in plain LAMMPS: its own pair law, its own rigid wall (`fix wall/gran`) instead of the structure, and
/// a second one at x1 = 0 instead of the mirror. What the coupled program is compared with.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <vector>

#include "contact/rest_on.hpp"
#include "dem-service/lammps/session.hpp"
#include "dem-service/slug/model.hpp"
#include "dem-service/slug/packing.hpp"

#define LAMMPS_LIB_MPI
#include <lammps/library.h>

namespace grainstep::bench {

/// Half model only. The laws are calibrated for the step dt (s), as in the coupled program.
class PlainSlug {
 public:
  PlainSlug(const dem::SlugModel& model, double dt) : session_(MPI_COMM_SELF, {}) {
    define_style();
    create_particles(model);
    define_laws(model, dt);
  }

  void run(std::uint64_t steps) { say("run %llu post no", static_cast<unsigned long long>(steps)); }

 private:
  template <class... Values>
  void say(const char* format, Values... values) {
    char text[500];
    std::snprintf(text, sizeof text, format, values...);
    session_.command(text);
  }

  void define_style() {
    for (const char* line :
         {"units si", "atom_style sphere", "dimension 2", "newton on", "boundary s s p", "comm_modify vel yes"}) {
      session_.command(line);
    }
  }

  void create_particles(const dem::SlugModel& model) {
    const double radius = model.diameter / 2.0;
    const std::vector<double> diameters(model.particles, model.diameter);
    const dem::PackingBox box{{{0.0, 0.0}}, {{model.half_width, model.height}}};
    auto centres = dem::pack_at_random(box, diameters, model.seed);
    contact::rest_on(surface::Polyline({{{-1.0, 0.0}}, {{1.0, 0.0}}}, {{0, 1}}), std::span(&radius, 1), centres);
    std::vector<int> id;
    const std::vector<int> type(centres.size(), 1);
    std::vector<double> x;
    std::vector<double> v;
    for (const auto& centre : centres) {
      id.push_back(static_cast<int>(id.size()) + 1);
      x.insert(x.end(), {centre[0], centre[1], 0.0});
      v.insert(v.end(), {0.0, -model.speed, 0.0});
    }
    say("region slug block 0 %g -0.01 %g %g %g units box", model.half_width, model.height, -radius, radius);
    say("create_box 1 slug");
    lammps_create_atoms(session_.handle(), static_cast<int>(id.size()), id.data(), type.data(), x.data(), v.data(),
                        nullptr, 0);
    say("set type 1 diameter %.17g", model.diameter);
    say("set type 1 density/disc %.17g", model.mass / (M_PI * radius * radius));
  }

  void define_laws(const dem::SlugModel& model, double dt) {
    const dem::ContactLaw pair = dem::calibrated_pair_law(model, dt);
    const dem::ContactLaw wall = dem::calibrated_surface_law(model, dt);
    say("pair_style gran/hooke/history %.17g %.17g %.17g 0 %.17g 0", pair.normal_stiffness, pair.tangential_stiffness,
        pair.damping_rate, pair.friction);
    say("pair_coeff * *");
    say("neighbor %.17g bin", model.diameter);
    say("neigh_modify delay 0 every 1 check yes binsize %.17g", 2.0 * model.diameter);
    say("timestep %.17g", dt);
    say("fix motion all nve/sphere disc");
    say("fix ground all wall/gran hooke/history %.17g %.17g %.17g 0 %.17g 0 yplane 0 NULL", wall.normal_stiffness,
        wall.tangential_stiffness, wall.damping_rate, wall.friction);
    say("fix mirror all wall/gran hooke/history %.17g 0 %.17g 0 0 0 xplane 0 NULL", 2.0 * pair.normal_stiffness,
        pair.damping_rate);
    say("timer loop");
    say("thermo_modify lost ignore");
    say("run 0 post no");
  }

  dem::LammpsSession session_;
};

}  // namespace grainstep::bench
