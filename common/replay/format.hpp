/// @file surface.h5: all that passed the surface in a run, one row for each window. docs/user/results.md is its
/// catalogue; About (record.proto) is what it says about itself.
#pragma once

namespace grainstep::replay {

inline constexpr const char* record_file = "surface.h5";  ///< in the directory of a run

namespace dataset {
inline constexpr const char* about = "/about";
inline constexpr const char* facet = "/facet";
inline constexpr const char* time = "/time";
inline constexpr const char* impulse = "/impulse";
inline constexpr const char* position = "/position";
inline constexpr const char* velocity = "/velocity";
inline constexpr const char* impactor_energy = "/impactor/energy";      // at t = 0
inline constexpr const char* impactor_momentum = "/impactor/momentum";  // at t = 0
}  // namespace dataset

}  // namespace grainstep::replay
