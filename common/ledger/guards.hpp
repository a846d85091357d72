/// @file The limits beyond which a run is not worth continuing. Pure.
#pragma once

#include <optional>
#include <string>

#include "grainstep/scene.pb.h"
#include "ledger/ledger.hpp"

namespace grainstep::ledger {

/// What the guards look at, at the end of one window.
struct Guarded {
  Balance balance;
  std::optional<double> overlap;          ///< largest overlap over the diameter since the last report
  std::optional<double> element_quality;  ///< smallest element area over its initial area
  scene::Impactor::Type impactor = scene::Impactor::TYPE_UNSET;  ///< for the advice
};

/// nullopt: all is well. Otherwise what was found, what was allowed, what it means and what to do, in one text.
[[nodiscard]] std::optional<std::string> violation(const scene::Guards& guards, const Guarded& guarded);

}  // namespace grainstep::ledger
