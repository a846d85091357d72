/// @file An impactor without mass or particles: a prescribed pressure that follows the surface, or nothing at all.
///
/// A window of length T is done in p steps h = T/p. Step k belongs to the time k h and hands over the pressure's
/// impulse from (k - 1/2) h to (k + 1/2) h (at k = 0: from 0 to h/2) on the surface as it is at k h, which moves
/// linearly within a window. So the impulse of a run is that of the history, to round-off, at any step.
///
/// Ledgers: the load has no momentum and no energy of its own. What it gives to the structure it takes from outside,
/// which is booked as its support: support_impulse = -interface_impulse, support_work = -interface_work. The whole then
/// gains what comes from outside, and the balance of both sides stays what it is for any impactor
/// (docs/theory/step.md).
#pragma once

#include <optional>
#include <vector>

#include "fe-service/load/loaded_patch.hpp"
#include "load/surface_account.hpp"
#include "participant/backend.hpp"

namespace grainstep::fe {

class PrescribedLoad final : public participant::ImpactorBackend {
 public:
  [[nodiscard]] wire::Hello describe() const override;
  /// InputError for an impactor that is neither `pressure` nor `none`.
  [[nodiscard]] wire::Ready prepare(const wire::Setup& setup) override;
  void run(const wire::Start& start, participant::ImpactorLink& link) override;

  /// What a window leaves for the next one.
  template <class Archive>
  void serialize(Archive& archive) {
    archive.fixed("surface", now_);
    archive("account", account_);
  }

 private:
  using Doubles = std::vector<double>;

  [[nodiscard]] double step_impulse(std::uint64_t step) const;
  void evaluate(std::uint64_t window);
  void take(const wire::Kinematics& surface);
  void hand_over(std::uint64_t window, participant::ImpactorLink& link);
  void send_report(std::uint64_t window, participant::ImpactorLink& link) const;

  std::optional<scene::Pressure> pressure_;  ///< nullopt: nothing
  std::optional<LoadedPatch> patch_;
  Measure measure_ = PlaneStrain{0.0};
  double step_ = 0.0;  ///< h, s
  std::uint32_t steps_ = 1;

  Doubles before_, now_, between_;  ///< m, surface at the last two exchanges, and between them
  Doubles impulse_;                 ///< N s, nodal, of this window
  Doubles last_step_;               ///< N s, nodal, of this window's last step
  load::SurfaceAccount account_;
};

}  // namespace grainstep::fe
