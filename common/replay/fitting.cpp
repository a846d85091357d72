#include "replay/fitting.hpp"

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "declare/declaration.hpp"
#include "participant/hello.hpp"

namespace grainstep::replay {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& what, const std::string& recorded,
                         const std::string& asked) {
  throw InputError(key + ": was recorded with " + what + " " + recorded + ", this scene has " + asked +
                   ". Take a record of the same kind of scene");
}

std::string word(scene::Symmetry symmetry) { return declare::word_for(*scene::Symmetry_descriptor(), symmetry); }

std::string half(bool mirror) { return mirror ? "half, with a mirror" : "full"; }

}  // namespace

void require_fits(const wire::Setup& setup, const record::About& about, const std::string& key) {
  if (setup.symmetry() != about.symmetry()) {
    refuse(key, "symmetry", word(about.symmetry()), word(setup.symmetry()));
  }
  if (setup.dimension() != about.dimension()) {
    refuse(key, "dimension", std::to_string(about.dimension()), std::to_string(setup.dimension()));
  }
  const bool has_depth = setup.symmetry() == scene::SYMMETRY_PLANE_STRAIN;
  if (has_depth && setup.depth() != about.depth()) {
    refuse(key, "a depth of", rounded_text(about.depth()) + " m", rounded_text(setup.depth()) + " m");
  }
  if (setup.mirror() != about.mirror()) {
    refuse(key, "an extent of", half(about.mirror()), half(setup.mirror()));
  }
}

wire::Ready ready_of(const wire::Ready& recorded, const wire::Setup& setup, const Recording& recording) {
  wire::Ready out = recorded;
  out.set_scene_hash(setup.scene_hash());
  out.set_ledger(wire::INTERFACE);
  out.set_memory(0);
  out.set_rank_memory(0);
  out.set_seconds_per_step(0.0);
  out.clear_fact();
  out.clear_warning();
  const record::About& about = recording.about();
  const std::string title = about.title().empty() ? "a run without title" : "\"" + about.title() + "\"";
  const std::string side = recorded.has_surface() ? "structure" : "impactor";
  participant::add_fact(out, side,
                        "recorded of " + title + ": " + std::to_string(recording.last()) + " windows of " +
                            rounded_text(about.window(), 4) + " s, to " + rounded_text(recording.end(), 4) + " s");
  return out;
}

}  // namespace grainstep::replay
