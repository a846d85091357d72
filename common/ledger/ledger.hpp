/// @file Momentum and energy of the whole: both sides' reports of one window against what they started with.
/// The equations and signs are in docs/theory/step.md. Pure: no input or output.
#pragma once

#include "grainstep/wire.pb.h"
#include "ledger/impulse_sums.hpp"

namespace grainstep::ledger {

/// One side's momentum: what it should have from what it received, against what it has.
struct Closure {
  Vector change{};      ///< N s, momentum now minus momentum at the start
  Vector interface {};  ///< N s, received through the surface
  Vector support{};     ///< N s, received from supports
  double error = 0.0;   ///< |change - interface - support| over the reference
};

/// The ledgers at the end of one window. Pure numbers unless a unit is given: over the reference of momentum or energy.
struct Balance {
  Closure impactor;
  Closure structure;
  Vector in_flight{};  ///< N s: given by the impactor, not yet taken up by the structure; 0 with equal steps
  double interface_momentum = 0.0;  ///< what the sides claim to have received, beyond what the messages carried
  double momentum_error = 0.0;   ///< of the whole: change of both - supports - in flight, or the interface's, if larger
  double energy = 0.0;           ///< J: kinetic, stored and dissipated of both, less the supports' work
  double energy_change = 0.0;    ///< of the whole: energy less initial energy
  double impactor_energy = 0.0;  ///< not explained by the work done on it through the surface
  double structure_energy = 0.0;    ///< the same
  double interface_mismatch = 0.0;  ///< J: work on the surface as the impactor sees it, less as the structure does
  double energy_drift = 0.0;        ///< largest of those four: gain in one must not hide loss in another
  double energy_reference = 0.0;    ///< J
  double momentum_reference = 0.0;  ///< N s
};

/// Everything that one side still has, has lost to dissipation, or has passed to its supports, in J.
[[nodiscard]] double energy_of(const wire::Energy& energy);

/// What both sides weigh, kg (Ready.mass); 0 where it is not known.
struct Masses {
  double impactor = 0.0;
  double structure = 0.0;
};

/// Which books the sides keep (Ready.ledger). Of a side that keeps only those of the interface, its own closures and
/// those of the whole are not judged, and are no numbers in a Balance.
struct Levels {
  wire::Ledger impactor = wire::FULL;
  wire::Ledger structure = wire::FULL;
  [[nodiscard]] bool full() const { return impactor == wire::FULL && structure == wire::FULL; }
};

/// The references, so that errors are parts of what is there, also where nothing moves at the start (a prescribed
/// load): the energy of the start or, if larger, the most that has been supplied from outside so far (support work:
/// never what an unstable exchange makes of itself); the momentum of the start - at least what each side would have if
/// all of its mass moved with the energy it has - or, if larger, the largest impulse handed over so far. Where both are
/// zero, nothing has happened: an error is then all there is, i.e. 1. A work that has just begun is no measure yet,
/// since both sides know it to a part of a window: before ten windows of it, it is taken as if it had gone on for ten.
class Ledger {
 public:
  /// The reports of window 0 (or of the window at which a run continues). `equal_steps`: one impactor step per window;
  /// then the impactor, too, has taken up between all earlier windows' impulse and this one's.
  Ledger(const wire::Report& impactor, const wire::Report& structure, bool equal_steps, const Masses& masses = {},
         const Levels& levels = {});

  /// Both reports belong to one window, `handed_over` to the same; windows in order, for the references grow.
  [[nodiscard]] Balance close(const wire::Report& impactor, const wire::Report& structure,
                              const HandedOver& handed_over);

  /// What rows have left, of a ledger that was made of the same reports.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("supplied", supplied_);
    archive("reference of momentum", momentum_reference_);
  }

 private:
  [[nodiscard]] Closure side(const wire::Momentum& now, const wire::Momentum& start, wire::Ledger level) const;
  [[nodiscard]] double interface_excess(const Balance& balance, const HandedOver& handed_over) const;
  [[nodiscard]] double relative(double momentum) const;
  void close_energy(const wire::Report& impactor, const wire::Report& structure, std::uint64_t acting, Balance& out);

  wire::Momentum impactor_start_;
  wire::Momentum structure_start_;
  double impactor_start_energy_;   // J, less the work done on it
  double structure_start_energy_;  // the same
  bool equal_steps_;
  Levels levels_;
  double initial_energy_;
  double supplied_ = 0.0;      // J
  double momentum_reference_;  // N s
};

}  // namespace grainstep::ledger
