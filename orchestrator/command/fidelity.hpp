/// @file How accurate a scene's resolution is, and which one to take: from the study configs/studies/speed-error.yaml,
/// whose series.csv is compiled in as fidelity.csv (`make accuracy` writes it again).
///
/// Valid for what was measured: a slug of cylinders on a monolithic beam. Particles count by a/D, because the slug's
/// momentum and overlap do not depend on D in two dimensions; the mesh by elements per half thickness.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grainstep/scene.pb.h"

namespace grainstep::orchestrator {

struct Fidelity {
  std::string name;              ///< of the study's series
  double particles_across = 0;   ///< a/D
  double refinement = 0;         ///< elements per h
  double error_deflection = 0;   ///< %, root mean square over seeds, against the finest run; 0: that run itself
  double error_impulse = 0;      ///< %
  double error_pressure = 0;     ///< %
  double processor_seconds = 0;  ///< of the reference beam
};

/// The rows of a study's series.csv that leave both steps to `auto` and have numbers; of the series "native, ..." only
/// the run that all others are compared with. Coarse particles deflect the beam
/// too much and coarse meshes too little; where the two happen to cancel, they need not do so in another scene. So a
/// setting's errors are the largest of all settings that are in nothing coarser. @throws InputError
[[nodiscard]] std::vector<Fidelity> read_fidelities(const std::string& csv);

/// Those that are compiled in.
[[nodiscard]] const std::vector<Fidelity>& measured_fidelities();

/// Whether they say anything about this scene.
[[nodiscard]] bool is_like_the_measured(const scene::Scene& scene);

/// The finest one that is in nothing finer than the scene; nullptr: the scene is coarser than all of them.
[[nodiscard]] const Fidelity* fidelity_of(const scene::Scene& scene, const std::vector<Fidelity>& measured);

/// The cheapest one with an error of the deflection below `percent`; nullptr: none.
[[nodiscard]] const Fidelity* cheapest_within(double percent, const std::vector<Fidelity>& measured);

/// `scene` at that fidelity, steps on auto.
[[nodiscard]] scene::Scene at_fidelity(const scene::Scene& scene, const Fidelity& fidelity);

}  // namespace grainstep::orchestrator
