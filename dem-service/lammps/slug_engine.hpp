/// @file A slug inside LAMMPS: particles created, laws set, all windows run. Everything here is collective.
#pragma once

#include "dem-service/lammps/engine.hpp"
#include "dem-service/lammps/impactor.hpp"
#include "dem-service/lammps/session.hpp"
#include "dem-service/slug/layout.hpp"

namespace grainstep::dem {

class SlugEngine final : public Engine {
 public:
  /// Packs the slug and creates its particles, standing on the surface or off it as the scene says. Throws InputError.
  SlugEngine(const EngineOptions& options, const wire::Setup& setup);

  /// These particles instead of a packed slug; everything else as the setup says.
  SlugEngine(const EngineOptions& options, const wire::Setup& setup, const std::vector<PlacedParticle>& particles);

  [[nodiscard]] const SlugModel& model() const { return model_; }

  [[nodiscard]] wire::Ready ready() const override { return ready_; }
  void run(const wire::Start& start, participant::ImpactorLink* link) override;

 private:
  void create_particles(const std::vector<PlacedParticle>& particles);
  void set_laws(const ContactLaw& pair, double dt, double skin);

  SlugModel model_;
  MPI_Comm communicator_;
  LammpsSession session_;
  wire::ImpactorSetup setup_;
  wire::Ready ready_;
};

}  // namespace grainstep::dem
