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
// of a recorded load: how fast the surface gives way, and beyond the recorded one, over the impactor's speed
inline constexpr std::string_view surface_speed_ratio = "surface_speed_ratio";
inline constexpr std::string_view surface_speed_departure = "surface_speed_departure";
inline constexpr std::string_view overlap = "max_overlap";  // over the diameter, since the last report
// of the structure
inline constexpr std::string_view deflection = "deflection";                                  // m, back face, mid-span
inline constexpr std::string_view peak_deflection = "peak_deflection";                        // m, of all steps so far
inline constexpr std::string_view peak_deflection_time = "peak_deflection_time";              // s
inline constexpr std::string_view peak_core_compression = "peak_core_compression";            // of the thickness
inline constexpr std::string_view peak_core_compression_time = "peak_core_compression_time";  // s
inline constexpr std::string_view element_quality = "min_element_quality";  // smallest area over initial area
}  // namespace observable

struct CataloguedObservable {
  wire::Role role;
  std::string_view name;
  std::string_view unit;  ///< UDUNITS; empty: a pure number
};

/// proto/README.md, "Report".
inline constexpr CataloguedObservable catalogue[] = {
    {wire::STRUCTURE, observable::deflection, "m"},
    {wire::STRUCTURE, "deflection_front", "m"},
    {wire::STRUCTURE, observable::peak_deflection, "m"},
    {wire::STRUCTURE, observable::peak_deflection_time, "s"},
    {wire::STRUCTURE, "core_compression", ""},
    {wire::STRUCTURE, observable::peak_core_compression, ""},
    {wire::STRUCTURE, observable::peak_core_compression_time, "s"},
    {wire::STRUCTURE, observable::element_quality, ""},
    {wire::STRUCTURE, "stable_step", "s"},
    {wire::STRUCTURE, "max_surface_speed", "m/s"},
    {wire::STRUCTURE, "max_plastic_strain", ""},
    {wire::STRUCTURE, "plastic_elements", ""},
    {wire::STRUCTURE, "velocity", "m/s"},
    {wire::IMPACTOR, observable::overlap, ""},
    {wire::IMPACTOR, "max_particle_speed", "m/s"},
    {wire::IMPACTOR, "slug_top", "m"},
    {wire::IMPACTOR, "slug_spread", "m"},
    {wire::IMPACTOR, "contacts_with_surface", ""},
    {wire::IMPACTOR, "foam_element_quality", ""},
    {wire::IMPACTOR, "foam_stable_step", "s"},
    {wire::IMPACTOR, "prescribed_pressure", "Pa"},
    {wire::IMPACTOR, "circumferential_share", ""},
    {wire::IMPACTOR, "circumferential_impulse", "N s"},
    {wire::IMPACTOR, "circumferential_work", "J"},
    {wire::IMPACTOR, observable::work_on_surface, "J"},
    {wire::IMPACTOR, "work_on_particles", "J"},
    {wire::IMPACTOR, observable::surface_speed_ratio, ""},
    {wire::IMPACTOR, observable::surface_speed_departure, ""},
};

/// Of a catalogued observable; nothing for one of a participant's own.
[[nodiscard]] inline std::optional<std::string_view> unit_of(wire::Role role, std::string_view name) {
  for (const CataloguedObservable& one : catalogue) {
    if (one.role == role && one.name == name) return one.unit;
  }
  return std::nullopt;
}

[[nodiscard]] inline std::optional<double> find(const wire::Report& report, std::string_view name) {
  for (const wire::Observable& candidate : report.observable()) {
    if (candidate.name() == name) {
      return candidate.value();
    }
  }
  return std::nullopt;
}

}  // namespace grainstep::ledger
