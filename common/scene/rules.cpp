#include "scene/rules.hpp"

#include <algorithm>
#include <cmath>

#include "base/number_text.hpp"
#include "declare/read.hpp"
#include "scene/bulk_viscosity.hpp"
#include "scene/core.hpp"
#include "scene/encounter.hpp"
#include "scene/foam_rules.hpp"
#include "scene/groups.hpp"
#include "scene/sizes.hpp"
#include "scene/usual.hpp"

namespace grainstep::scene {
namespace {

using Findings = std::vector<Finding>;

/// Ratios are written by people, in decimals: 0.3333 is meant as a third only if it says so to six digits.
constexpr double ratio_tolerance = 1e-6;

bool is_whole(double value) {
  return std::round(value) >= 1 && std::abs(value / std::round(value) - 1) < ratio_tolerance;
}

bool divides_evenly(double ratio) { return is_whole(ratio) || is_whole(1 / ratio); }

void sizes_are_described(const Slug& slug, Findings& findings) {
  if (!slug.has_size_distribution()) return;
  const std::string path = "impactor.slug.size_distribution";
  for (const SizeProblem& problem : size_problems(slug.size_distribution())) {
    findings.push_back({Severity::error, problem.path.empty() ? path : path + "." + problem.path, problem.text});
  }
}

void slug_holds_particles(const Scene& scene, Findings& findings) {
  const Slug& slug = scene.impactor().slug();
  const double diameter = Sizes(slug, dimension(scene)).largest() * slug.particle().diameter();
  const double smallest = std::min(2 * slug.half_width(), slug.height());
  if (diameter <= smallest) return;
  findings.push_back({Severity::error, "impactor.slug.particle.diameter",
                      "a particle of " + metres(diameter) + " does not fit into a slug of " +
                          metres(2 * slug.half_width()) + " by " + metres(slug.height())});
}

void slice_is_read(const Scene& scene, Findings& findings) {
  if (scene.symmetry() == SYMMETRY_AXISYMMETRIC) return;
  const double absent = static_cast<const Slug&>(*declare::defaults_of(Slug())).slice_angle();
  if (scene.impactor().slug().slice_angle() == absent) return;
  findings.push_back({Severity::error, "impactor.slug.slice_angle",
                      "nobody would read it: with symmetry: plane_strain the slug is one of cylinders; set symmetry: "
                      "axisymmetric, or leave this out"});
}

void deck_is_one(const Deck& deck, Findings& findings) {
  if (deck.file().empty() == deck.text().empty()) {
    findings.push_back({Severity::error, "impactor.deck", "expected either `file` or `text`: the script"});
  }
  if (!deck.has_contact()) {
    findings.push_back(
        {Severity::error, "impactor.deck", "required key 'contact' is missing: how its particles touch the structure"});
  }
}

/// A record is named where one is played, and nowhere else.
void replay_is_read(const std::string& side, bool replays, bool named, Findings& findings) {
  if (replays == named) return;
  findings.push_back(replays
                         ? Finding{Severity::error, side,
                                   "required key 'replay' is missing: " + side + ".type is replay, of which run?"}
                         : Finding{Severity::error, side + ".replay",
                                   "nobody would read it: " + side + ".type is not replay; set it, or leave this out"});
}

/// What a structure of ours needs. One of one's own may leave it out, and has then no dimensionless groups.
void structure_is_described(const Structure& structure, Findings& findings) {
  replay_is_read("structure", structure.type() == Structure::TYPE_REPLAY, structure.has_replay(), findings);
  if (is_described_elsewhere(structure)) return;
  const auto missing = [&findings](const char* key, const char* what) {
    findings.push_back({Severity::error, "structure", std::string("required key '") + key + "' is missing: " + what});
  };
  if (!structure.has_half_span()) missing("half_span", "Half span; of a circular plate its radius R.");
  if (structure.layers().empty()) missing("layers", "From the loaded face to the back face, at least one.");
}

/// What a type of impactor needs, and what it would not read. A slug may stay: scenes inherit it from what they
/// include.
void impactor_is_described(const Impactor& impactor, bool slug, Findings& findings) {
  if (slug && !impactor.has_slug()) {
    findings.push_back({Severity::error, "impactor",
                        "required key 'slug' is missing: what hits, unless impactor.type is pressure or none"});
  }
  replay_is_read("impactor", impactor.type() == Impactor::TYPE_REPLAY, impactor.has_replay(), findings);
  const bool deck = impactor.type() == Impactor::TYPE_DECK;
  if (deck != impactor.has_deck()) {
    findings.push_back(
        deck ? Finding{Severity::error, "impactor", "required key 'deck' is missing: impactor.type is deck, but which?"}
             : Finding{Severity::error, "impactor.deck",
                       "nobody would read it: impactor.type is not deck; set it, or leave this out"});
  }
  if (deck && impactor.has_deck()) deck_is_one(impactor.deck(), findings);
  const bool pressure = impactor.type() == Impactor::TYPE_PRESSURE;
  if (pressure && !impactor.has_pressure()) {
    findings.push_back(
        {Severity::error, "impactor", "required key 'pressure' is missing: impactor.type is pressure, but which?"});
  }
  if (!pressure && impactor.has_pressure()) {
    findings.push_back({Severity::error, "impactor.pressure",
                        "nobody would read it: impactor.type is not pressure; set it, or leave this out"});
  }
  if (impactor.has_pressure() && impactor.pressure().history_case() == Pressure::HISTORY_NOT_SET) {
    findings.push_back(
        {Severity::error, "impactor.pressure", "needs a history: one of rectangular, exponential, tabulated"});
  }
}

void table_is_one(const TabulatedPulse& table, Findings& findings) {
  if (table.time_size() != table.pressure_size()) {
    findings.push_back({Severity::error, "impactor.pressure.tabulated.pressure",
                        std::to_string(table.pressure_size()) + " pressures for " + std::to_string(table.time_size()) +
                            " times; expected one for each"});
  }
  for (int k = 0; k + 1 < table.time_size(); ++k) {
    if (table.time(k) < table.time(k + 1)) continue;
    findings.push_back({Severity::error, "impactor.pressure.tabulated.time." + std::to_string(k + 1),
                        rounded_text(table.time(k + 1)) + " s follows " + rounded_text(table.time(k)) +
                            " s; times must increase strictly"});
  }
}

/// `range`, if it is given, covers a part of `whole`.
struct Cover {
  bool given;
  const Range& range;
  Span whole;
  std::string what;
};

void covers_a_part(const Cover& cover, const std::string& path, Findings& findings) {
  if (!cover.given) return;
  const std::string range = "from " + metres(cover.range.from()) + " to " + metres(cover.range.to());
  if (!(cover.range.from() < cover.range.to())) {
    findings.push_back({Severity::error, path, range + " has no length; expected from < to"});
  } else if (!(common_part(cover.whole, cover.range).length() > 0.0)) {
    findings.push_back({Severity::error, path,
                        range + " lies beside " + cover.what + ", which reaches from " + metres(cover.whole.from) +
                            " to " + metres(cover.whole.to)});
  }
}

void velocities_apply(const Structure& structure, Findings& findings) {
  const bool fixed = structure.type() == Structure::TYPE_RIGID && structure.motion() != Structure::MOTION_FREE;
  if (fixed && structure.initial_velocity_size() > 0) {
    findings.push_back({Severity::error, "structure.initial_velocity",
                        "a rigid target that does not move has no velocity; set structure.motion to free"});
  }
  double thickness = 0.0;
  for (const Layer& layer : structure.layers()) thickness += layer.thickness();
  for (int i = 0; i < structure.initial_velocity_size(); ++i) {
    const InitialVelocity& field = structure.initial_velocity(i);
    const std::string path = "structure.initial_velocity." + std::to_string(i) + ".";
    covers_a_part({field.has_patch(), field.patch(), loaded_face(structure), "the span"}, path + "patch", findings);
    covers_a_part({field.has_depth(), field.depth(), {0.0, thickness}, "the thickness"}, path + "depth", findings);
    if (!field.has_layer() || static_cast<int>(field.layer()) < structure.layers_size()) continue;
    findings.push_back({Severity::error, path + "layer",
                        "found " + std::to_string(field.layer()) + ", but the layers are counted from 0 to " +
                            std::to_string(structure.layers_size() - 1)});
  }
}

void motion_is_read(const Structure& structure, Findings& findings) {
  const bool clamped = structure.type() == Structure::TYPE_BEAM || structure.type() == Structure::TYPE_PLATE;
  if (structure.motion() != Structure::MOTION_FREE || !clamped) return;
  const std::string what = structure.type() == Structure::TYPE_BEAM ? "a beam" : "a plate";
  findings.push_back({Severity::error, "structure.motion", what + " is clamped; only the type rigid can be free"});
}

void symmetry_fits(const Scene& scene, Findings& findings) {
  const bool ring = scene.symmetry() == SYMMETRY_AXISYMMETRIC;
  const Structure& structure = scene.structure();
  if (scene.symmetry() == SYMMETRY_NONE && !is_described_elsewhere(structure)) {
    findings.push_back(
        {Severity::error, "symmetry",
         "none is for structures of the types external and replay: ours compute in plane strain, or as solids of "
         "revolution"});
  }
  if (ring && structure.type() == Structure::TYPE_BEAM) {
    findings.push_back({Severity::error, "structure.type",
                        "a beam is not a solid of revolution; with symmetry: axisymmetric take plate or rigid"});
  }
  if (!ring && structure.type() == Structure::TYPE_PLATE) {
    findings.push_back({Severity::error, "symmetry", "a circular plate needs axisymmetric"});
  }
  if (ring && structure.extent() == Structure::EXTENT_FULL) {
    findings.push_back({Severity::error, "structure.extent",
                        "half is the whole of a solid of revolution (0 <= r <= R); full is for plane strain"});
  }
}

void steps_meet(const Steps& steps, Findings& findings) {
  const auto& structure = steps.structure();
  if (structure.has_ratio() && !divides_evenly(structure.ratio())) {
    findings.push_back({Severity::error, "steps.structure",
                        "a ratio of " + rounded_text(structure.ratio()) +
                            " to the impactor's step: the two sides would never meet; expected a whole number or one "
                            "over a whole number"});
  }
  if (!structure.has_seconds() || !steps.impactor().has_seconds()) return;
  const double ratio = structure.seconds() / steps.impactor().seconds();
  if (divides_evenly(ratio)) return;
  findings.push_back(
      {Severity::error, "steps.structure",
       "is " + rounded_text(ratio) +
           " times the impactor's step: the two sides would never meet; expected a whole number of steps "
           "of one in a step of the other"});
}

/// @param end s, not a number where it cannot be told.
void end_is_a_time(const Time& time, double end, Findings& findings) {
  if (!std::isnan(end)) return;
  findings.push_back({Severity::error, "time.end",
                      "found " + rounded_text(time.end().t_bar()) +
                          ", and a bare number counts L sqrt(rho_m/sigma_Y), but no layer of this structure yields: "
                          "there is no sigma_Y. Write seconds, with their unit"});
}

void step_fits_run(const Step& step, const std::string& path, double end, Findings& findings) {
  if (!step.has_seconds() || !(step.seconds() > end)) return;
  findings.push_back({Severity::error, path,
                      "a step of " + rounded_text(step.seconds()) + " s is longer than the whole run (time.end is " +
                          rounded_text(end) + " s)"});
}

std::string layer_path(int index) { return "structure.layers." + std::to_string(index); }

void core_is_described(const Scene& scene, int index, Findings& findings) {
  const Structure& structure = scene.structure();
  const Layer& layer = structure.layers(index);
  if (layer.has_viscosity() && layer.material() != Layer::MATERIAL_CORE) {
    findings.push_back({Severity::error, layer_path(index) + ".viscosity", "only a layer of material core has one"});
  }
  if (layer.material() != Layer::MATERIAL_CORE) return;
  if (index == 0) {
    findings.push_back({Severity::error, layer_path(index) + ".material",
                        "the first layer cannot be a core: it is the face whose material a core is made of"});
    return;
  }
  if (!structure.core().has_normalised_strength()) {
    findings.push_back({Severity::error, "structure.core",
                        "required key 'normalised_strength' is missing: " + layer_path(index) + " is a core"});
  }
  const double relative = core_relative_density(structure, layer);
  if (!(densification_strain(relative) > 0)) {
    findings.push_back({Severity::error, layer_path(index) + ".density",
                        "a core of relative density " + rounded_text(relative) +
                            " has no room to densify (3.9); expected less than " +
                            rounded_text(structure.layers(0).density() / 1.5) + " kg/m^3"});
  }
  if (!layer.has_viscosity() && !scene.impactor().has_slug()) {
    findings.push_back({Severity::error, layer_path(index),
                        "required key 'viscosity' is missing: without a slug there is no speed to derive it from"});
  }
}

}  // namespace

std::vector<Finding> check_rules(const Scene& scene) {
  Findings findings;
  const bool slug = has_slug(scene);
  structure_is_described(scene.structure(), findings);
  impactor_is_described(scene.impactor(), slug, findings);
  if (scene.impactor().pressure().has_tabulated()) table_is_one(scene.impactor().pressure().tabulated(), findings);
  if (slug && scene.impactor().has_slug()) sizes_are_described(scene.impactor().slug(), findings);
  if (!findings.empty()) return findings;  // nothing more can be said without it
  const double end = groups(scene).end;
  const bool foam = scene.impactor().type() == Impactor::TYPE_FOAM;
  if (slug) {
    foam ? check_foam(scene, findings) : slug_holds_particles(scene, findings);
    slice_is_read(scene, findings);
    if (scene.structure().has_half_span()) check_encounter(scene, findings);
  }
  const Pressure& pressure = scene.impactor().pressure();
  covers_a_part({pressure.has_patch() && scene.structure().has_half_span(), pressure.patch(),
                 loaded_face(scene.structure()), "the loaded face"},
                "impactor.pressure.patch", findings);
  motion_is_read(scene.structure(), findings);
  if (!scene.structure().layers().empty()) check_bulk_viscosity(scene, findings);
  symmetry_fits(scene, findings);
  velocities_apply(scene.structure(), findings);
  for (int i = 0; i < scene.structure().layers_size(); ++i) core_is_described(scene, i, findings);
  end_is_a_time(scene.time(), end, findings);
  steps_meet(scene.steps(), findings);
  step_fits_run(scene.steps().impactor(), "steps.impactor", end, findings);
  step_fits_run(scene.steps().structure(), "steps.structure", end, findings);
  check_usual(scene, findings);
  return findings;
}

}  // namespace grainstep::scene
