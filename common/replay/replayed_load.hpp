/// @file An impactor that gives a structure what another run has recorded: `impactor.type: replay`.
///
/// To the structure of the record, in its windows, the same bits; so that structure's results are those of the run. To
/// another one the load as it was, which that structure cannot change: particles that meet a faster surface would give
/// less. How far the surfaces differ is what it reports (surface_speed_departure).
///
/// Ledgers: as a prescribed pressure's, what it gives comes from outside, and is booked as its support's. The momentum
/// and energy that the recorded impactor had at t = 0 are its own, unchanged: what errors are measured against.
#pragma once

#include <optional>
#include <vector>

#include "load/surface_account.hpp"
#include "participant/backend.hpp"
#include "replay/load_history.hpp"

namespace grainstep::replay {

class ReplayedLoad final : public participant::ImpactorBackend {
 public:
  [[nodiscard]] wire::Hello describe() const override;
  /// InputError for another type, a record that cannot be read, or one that does not fit.
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override;
  void run(const wire::Start& start, participant::ImpactorLink& link) override;

  /// What a window leaves for the next one.
  template <class Archive>
  void serialize(Archive& archive) {
    archive("account", account_);
    archive("retreat", retreat_);
  }

 private:
  void hand_over(std::uint64_t window, participant::ImpactorLink& link);
  void send_report(std::uint64_t window, participant::ImpactorLink& link) const;

  std::optional<Recording> recording_;
  std::optional<LoadHistory> history_;
  std::uint64_t steps_ = 1;
  std::vector<double> impulse_;  ///< N s, nodal, of this window
  load::SurfaceAccount account_;
  LoadHistory::Retreat retreat_;  ///< so far
};

}  // namespace grainstep::replay
