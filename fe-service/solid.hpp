/// @file The scene's symmetry as a measure.
#pragma once

#include "fe-service/measure.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::fe {

/// `depth` b in m, of plane strain. Throws InputError for a symmetry that this program does not know.
[[nodiscard]] Measure make_measure(scene::Symmetry symmetry, double depth);

/// Throws InputError for a structure that cannot have this measure: a beam of revolution, a plate in plane strain, a
/// solid of revolution on both sides of its axis.
void check_measure(const scene::Structure& structure, const Measure& measure);

}  // namespace grainstep::fe
