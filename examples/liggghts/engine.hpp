/// @file LIGGGHTS, with the particles of a slug in it. One per process: it shares the names of its classes with
/// LAMMPS, so that no program may hold both.
#pragma once

#include <dem-service/slug/exchange.hpp>
#include <dem-service/slug/layout.hpp>
#include <dem-service/slug/model.hpp>
#include <dem-service/slug/step_driver.hpp>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

class Engine {
 public:
  /// Throws grainstep::NumericalError with LIGGGHTS's own words, as run() does. `log`: file name, empty for none.
  Engine(const grainstep::dem::SlugModel& model, const std::vector<grainstep::dem::PlacedParticle>& particles,
         const std::string& log);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  struct Settings {
    double dt = 0.0;    ///< s
    double skin = 0.0;  ///< m, of the neighbour lists
  };
  /// All steps, or up to the one after which the driver has ended.
  void run(int steps, const Settings& settings, grainstep::dem::StepDriver& driver, grainstep::dem::Exchange& exchange);

 private:
  template <typename... Parts>
  void command(const Parts&... parts);
  void make_box(const std::vector<grainstep::dem::PlacedParticle>& particles);
  void make_particles(const std::vector<grainstep::dem::PlacedParticle>& particles);
  void set_laws(const Settings& settings);

  grainstep::dem::SlugModel model_;
  void* handle_ = nullptr;
  LAMMPS_NS::LAMMPS* liggghts_ = nullptr;
};
