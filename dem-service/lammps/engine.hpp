/// @file What makes particles inside LAMMPS and steps them: a slug (slug_engine.hpp) or a script
/// (deck/deck_engine.hpp).
#pragma once

#include "participant/backend.hpp"

namespace grainstep::dem {

class Engine {
 public:
  virtual ~Engine() = default;

  /// Without scene and memory.
  [[nodiscard]] virtual wire::Ready ready() const = 0;

  /// Runs all windows. `link`: rank 0's, nullptr elsewhere. Throws InputError, NumericalError or what the link throws;
  /// on the other ranks only what LAMMPS itself finds.
  virtual void run(const wire::Start& start, participant::ImpactorLink* link) = 0;
};

}  // namespace grainstep::dem
