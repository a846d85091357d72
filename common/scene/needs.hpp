/// @file What a scene asks of the participants: words of the catalogue of capabilities in proto/README.md. Whoever does
/// not say a word cannot compute what it stands for, and would leave it out without telling.
#pragma once

#include <string>
#include <vector>

#include "grainstep/scene.pb.h"
#include "grainstep/wire.pb.h"

namespace grainstep::scene {

struct Need {
  std::string word;
  std::string key;  ///< of the scene, that asks for it
};

[[nodiscard]] std::vector<Need> needs(const Scene& scene, wire::Role role);

/// Of surface, impulses and momenta: 3 with symmetry: none, else 2.
[[nodiscard]] unsigned surface_dimension(const Scene& scene);

/// The command that computes this side: the scene's program or, where it names none, ours for this type. Empty: it is
/// always started by somebody else.
struct Program {
  std::vector<std::string> command;
  bool own = true;     ///< one of ours
  bool ranks = false;  ///< may run as several MPI ranks
};
[[nodiscard]] Program program_of(const Scene& scene, wire::Role role);

}  // namespace grainstep::scene
