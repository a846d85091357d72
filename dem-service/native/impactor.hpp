/// @file The native particle engine as a backend for participant::serve_impactor: slugs of discs or spheres, no LAMMPS.
#pragma once

#include <memory>

#include "participant/backend.hpp"

namespace grainstep::dem::native {

[[nodiscard]] std::unique_ptr<participant::ImpactorBackend> make_impactor(int threads = 1);

}  // namespace grainstep::dem::native
