#include "orchestrator/command/fidelity.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "orchestrator_fidelity_table.hpp"
#include "scene/sizes.hpp"

namespace grainstep::orchestrator {
namespace {

constexpr double a_little = 1.0 + 1e-9;  // a/D is a quotient of two rounded numbers

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

using Row = std::map<std::string, std::string>;

double number(const Row& row, const std::string& column) {
  const auto found = row.find(column);
  if (found == row.end()) {
    throw InputError("the table of fidelities has no column '" + column + "'");
  }
  std::istringstream in(found->second);
  double value = 0.0;
  if (!(in >> value)) {
    throw InputError("the table of fidelities: '" + found->second + "' in column '" + column + "' is not a number");
  }
  return value;
}

bool is_no_coarser(const Fidelity& one, const Fidelity& other) {
  return one.particles_across >= other.particles_across && one.refinement >= other.refinement;
}

std::vector<Fidelity> without_luck(const std::vector<Fidelity>& measured) {
  std::vector<Fidelity> out = measured;
  for (Fidelity& one : out) {
    for (const Fidelity& finer : measured) {
      if (is_no_coarser(finer, one)) {
        one.error_deflection = std::max(one.error_deflection, finer.error_deflection);
        one.error_impulse = std::max(one.error_impulse, finer.error_impulse);
        one.error_pressure = std::max(one.error_pressure, finer.error_pressure);
      }
    }
  }
  return out;
}

bool is_empty(const Row& row, const std::string& column) {
  const auto found = row.find(column);
  return found == row.end() || found->second.empty();
}

}  // namespace

std::vector<Fidelity> read_fidelities(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<Fidelity> out;
  while (std::getline(lines, line)) {
    const std::vector<std::string> cells = cells_of(line);
    Row row;
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) {
      row[names[i]] = cells[i];
    }
    const bool automatic = is_empty(row, "impactor_ratio") && is_empty(row, "structure_ratio");
    if (!automatic || is_empty(row, "error_deflection")) {
      continue;
    }
    // The errors of the native engine are those of LAMMPS, its seconds are not: of its rows only the run that all are
    // compared with counts.
    const bool native = row["series"].starts_with("native, ");
    if (native && number(row, "error_deflection") > 0.0) continue;
    out.push_back({.name = row["series"],
                   .particles_across = number(row, "particles_across"),
                   .refinement = number(row, "refinement"),
                   .error_deflection = number(row, "error_deflection"),
                   .error_impulse = number(row, "error_impulse"),
                   .error_pressure = number(row, "error_pressure"),
                   .processor_seconds = number(row, "processor_seconds")});
  }
  return without_luck(out);
}

const std::vector<Fidelity>& measured_fidelities() {
  static const std::vector<Fidelity> all = read_fidelities(fidelity_table);
  return all;
}

bool is_like_the_measured(const scene::Scene& scene) {
  const scene::Slug& slug = scene.impactor().slug();
  const bool plain = scene::Sizes(slug, scene::dimension(scene)).equal() && slug.angle() == 0.0 &&
                     slug.offset() == 0.0 && !slug.has_tail_speed() && !slug.confined();
  return plain && scene.symmetry() == scene::SYMMETRY_PLANE_STRAIN &&
         scene.impactor().type() == scene::Impactor::TYPE_SLUG &&
         scene.structure().type() == scene::Structure::TYPE_BEAM && scene.structure().layers_size() == 1;
}

const Fidelity* fidelity_of(const scene::Scene& scene, const std::vector<Fidelity>& measured) {
  const scene::Slug& slug = scene.impactor().slug();
  const double across = slug.half_width() / slug.particle().diameter() * a_little;
  const double refinement = scene.structure().mesh().refinement() * a_little;
  const Fidelity* best = nullptr;
  for (const Fidelity& one : measured) {
    const bool no_finer = one.particles_across <= across && one.refinement <= refinement;
    if (no_finer && (best == nullptr || one.error_deflection < best->error_deflection)) {
      best = &one;
    }
  }
  return best;
}

const Fidelity* cheapest_within(double percent, const std::vector<Fidelity>& measured) {
  const Fidelity* best = nullptr;
  for (const Fidelity& one : measured) {
    const bool within = one.error_deflection > 0.0 && one.error_deflection < percent;
    if (within && (best == nullptr || one.processor_seconds < best->processor_seconds)) {
      best = &one;
    }
  }
  return best;
}

scene::Scene at_fidelity(const scene::Scene& scene, const Fidelity& fidelity) {
  scene::Scene out = scene;
  scene::Slug& slug = *out.mutable_impactor()->mutable_slug();
  slug.mutable_particle()->set_diameter(slug.half_width() / fidelity.particles_across);
  out.mutable_structure()->mutable_mesh()->set_refinement(fidelity.refinement);
  out.mutable_steps()->mutable_impactor()->set_automatic(scene::Step::AUTO_AUTO);
  out.mutable_steps()->mutable_structure()->set_automatic(scene::Step::AUTO_AUTO);
  return out;
}

}  // namespace grainstep::orchestrator
