/// @file A LAMMPS script of one's own as the impactor: run up to its first `run`, then given contact with the surface
/// and driven step by step. Everything here is collective.
#pragma once

#include "base/temporary_directory.hpp"
#include "dem-service/deck/deck_model.hpp"
#include "dem-service/lammps/engine.hpp"
#include "dem-service/lammps/impactor.hpp"
#include "dem-service/lammps/session.hpp"

namespace grainstep::dem {

class DeckEngine final : public Engine {
 public:
  /// Runs the script. Throws InputError with LAMMPS's own words where it cannot be run.
  DeckEngine(const EngineOptions& options, const wire::Setup& setup);

  [[nodiscard]] wire::Ready ready() const override;
  void run(const wire::Start& start, participant::ImpactorLink* link) override;

 private:
  void run_script();

  EngineOptions options_;
  wire::Setup setup_;
  LammpsSession session_;
  DeckParticles particles_;
  SlugModel model_;
};

}  // namespace grainstep::dem
