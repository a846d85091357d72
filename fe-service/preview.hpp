/// @file What a structure would be, without building it: what a participant says before a run is started.
#pragma once

#include <cstdint>

#include "fe-service/foam/model.hpp"
#include "grainstep/scene.pb.h"
#include "grainstep/wire.pb.h"

namespace grainstep::fe {

struct StructurePreview {
  std::uint64_t elements = 0;  ///< triangles; 0 for a rigid target
  std::uint64_t nodes = 0;
  double areal_mass = 0.0;      ///< m_b, kg/m^2, sum over the layers
  double element_size = 0.0;    ///< m, side of a quad along the span
  double stable_step = 0.0;     ///< s, of the undeformed mesh, by the function that the run uses
  double preferred_step = 0.0;  ///< s
  double contact_mass = 0.0;    ///< kg, of a node inside the surface; 0 for a rigid target
  double free_mass = 0.0;       ///< kg, of a free rigid target, else 0
  std::uint64_t memory_bytes = 0;
  double seconds_per_element_step = 0.0;  ///< an estimate from bench_fe_kernel (docs/decisions/0003-element-loop.md)
  wire::Surface surface;                  ///< at rest

  /// The same as the message; without mass and scene.
  [[nodiscard]] wire::Ready ready() const;
};

struct FoamPreview {
  std::uint64_t elements = 0;
  double stable_step = 0.0;     ///< s
  double preferred_step = 0.0;  ///< s
  double contact_mass = 0.0;    ///< kg, of a node of the leading face
  double contact_time = 0.0;    ///< s
  double longest_window = 0.0;  ///< s
  std::uint64_t memory_bytes = 0;
  double seconds_per_element_step = 0.0;

  [[nodiscard]] wire::Ready ready() const;
};

/// Throws InputError for a foam projectile that grainstep-fe cannot compute.
[[nodiscard]] FoamPreview preview_foam(const scene::Impactor& impactor, const FoamSetting& setting);

/// Throws InputError for a structure that grainstep-fe cannot compute.
[[nodiscard]] StructurePreview preview(const scene::Structure& structure, scene::Symmetry symmetry, double depth);

}  // namespace grainstep::fe
