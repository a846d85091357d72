/// @file The scene that fuzzed sessions are about: both participants are somebody's own.
#pragma once

#include "grainstep/scene.pb.h"

namespace grainstep::fuzz {

inline constexpr std::uint64_t scene_hash = 42;
inline constexpr double run_end = 4e-3;  // s

/// `symmetry`: that of the surface, and whether it has two or three dimensions.
[[nodiscard]] inline scene::Scene played_scene(scene::Symmetry symmetry) {
  scene::Scene out;
  out.set_symmetry(symmetry);
  out.set_depth(1e-3);
  out.mutable_time()->mutable_end()->set_seconds(run_end);
  out.mutable_impactor()->set_type(scene::Impactor::TYPE_EXTERNAL);
  out.mutable_structure()->set_type(scene::Structure::TYPE_EXTERNAL);
  out.mutable_guards()->set_energy_drift(0.03);
  out.mutable_guards()->set_momentum_error(1e-9);
  out.mutable_guards()->set_overlap(0.5);
  out.mutable_guards()->set_element_quality(0.01);
  out.mutable_output()->set_rows(5);
  out.mutable_output()->set_snapshots(3);
  out.mutable_output()->set_profiles(2);
  return out;
}

}  // namespace grainstep::fuzz
