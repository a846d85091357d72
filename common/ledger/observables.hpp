/// @file The observables that the orchestrator itself understands; others are recorded as they come. Catalogue with
/// units: proto/README.md.
#pragma once

#include <optional>
#include <string_view>

#include "grainstep/wire.pb.h"

namespace grainstep::ledger {

namespace observable {
// of the impactor
inline constexpr std::string_view work_on_surface = "work_on_surface";  // J, since t = 0
inline constexpr std::string_view overlap = "max_overlap";              // over the diameter, since the last report
// of the structure
inline constexpr std::string_view deflection = "deflection";                                  // m, back face, mid-span
inline constexpr std::string_view peak_deflection = "peak_deflection";                        // m, of all steps so far
inline constexpr std::string_view peak_deflection_time = "peak_deflection_time";              // s
inline constexpr std::string_view peak_core_compression = "peak_core_compression";            // of the thickness
inline constexpr std::string_view peak_core_compression_time = "peak_core_compression_time";  // s
inline constexpr std::string_view element_quality = "min_element_quality";  // smallest area over initial area
}  // namespace observable

[[nodiscard]] inline std::optional<double> find(const wire::Report& report, std::string_view name) {
  for (const wire::Observable& candidate : report.observable()) {
    if (candidate.name() == name) {
      return candidate.value();
    }
  }
  return std::nullopt;
}

}  // namespace grainstep::ledger
