#include "scene/needs.hpp"

#include <algorithm>
#include <sstream>

#include "declare/declaration.hpp"

namespace grainstep::scene {
namespace {

template <typename Side>
std::string type_word(const Side& side) {
  return declare::word_for(*Side::Type_descriptor(), side.type());
}

void add_layers(const Structure& structure, std::vector<Need>& found) {
  for (int i = 0; i < structure.layers_size(); ++i) {
    const std::string word = declare::word_for(*Layer::Material_descriptor(), structure.layers(i).material());
    const auto same = [&word](const Need& need) { return need.word == word; };
    if (std::ranges::none_of(found, same)) {
      found.push_back({word, "structure.layers." + std::to_string(i) + ".material"});
    }
  }
}

// A rigid target has its layers for its mass alone, a structure of one's own for the dimensionless groups.
void add_structure(const Structure& structure, std::vector<Need>& found) {
  found.push_back({type_word(structure), "structure.type"});
  if (structure.type() == Structure::TYPE_BEAM || structure.type() == Structure::TYPE_PLATE)
    add_layers(structure, found);
  if (structure.initial_velocity_size() > 0) found.push_back({"initial_velocity", "structure.initial_velocity"});
  const BulkViscosity& bulk = structure.bulk_viscosity();
  if (bulk.linear() > 0.0 || bulk.quadratic() > 0.0) found.push_back({"bulk_viscosity", "structure.bulk_viscosity"});
}

void add_impactor(const Impactor& impactor, std::vector<Need>& found) {
  found.push_back({type_word(impactor), "impactor.type"});
  if (impactor.type() != Impactor::TYPE_SLUG) return;
  const Slug& slug = impactor.slug();
  if (slug.has_size_distribution()) found.push_back({"size_distribution", "impactor.slug.size_distribution"});
  if (slug.surface_contact().tension_cutoff()) {
    found.push_back({"tension_cutoff", "impactor.slug.surface_contact.tension_cutoff"});
  }
}

using Words = google::protobuf::EnumValueOptions;

const Words& words_of(const google::protobuf::EnumDescriptor& keys, int value) {
  return keys.FindValueByNumber(value)->options();
}

template <typename Side>
Program program_of_side(const Side& side, const Words& options) {
  const std::string& declared = options.GetExtension(options::program);
  std::istringstream words(declared);
  Program out;
  for (std::string word; words >> word;) out.command.push_back(word);
  out.ranks = options.GetExtension(options::ranks);
  const bool another = !side.program().empty() && (out.command.empty() || side.program() != out.command.front());
  if (another) out = {.command = {side.program()}, .own = false, .ranks = false};
  return out;
}

}  // namespace

std::vector<Need> needs(const Scene& scene, wire::Role role) {
  std::vector<Need> found;
  role == wire::IMPACTOR ? add_impactor(scene.impactor(), found) : add_structure(scene.structure(), found);
  if (scene.symmetry() == SYMMETRY_AXISYMMETRIC) found.push_back({"axisymmetric", "symmetry"});
  if (scene.symmetry() == SYMMETRY_PLANE_STRAIN) found.push_back({"plane_strain", "symmetry"});
  std::erase_if(found, [](const Need& need) { return need.word.empty(); });  // of a type that nobody has chosen
  return found;
}

unsigned surface_dimension(const Scene& scene) { return scene.symmetry() == SYMMETRY_NONE ? 3 : 2; }

Program program_of(const Scene& scene, wire::Role role) {
  const Structure& structure = scene.structure();
  const Impactor& impactor = scene.impactor();
  if (role == wire::STRUCTURE)
    return program_of_side(structure, words_of(*Structure::Type_descriptor(), structure.type()));
  if (impactor.type() != Impactor::TYPE_SLUG) {
    return program_of_side(impactor, words_of(*Impactor::Type_descriptor(), impactor.type()));
  }
  // A scene that nobody has loaded from a file has no defaults.
  const bool unset = impactor.engine() == Impactor::ENGINE_UNSET;
  const int engine = unset ? Impactor::ENGINE_LAMMPS : impactor.engine();
  return program_of_side(impactor, words_of(*Impactor::Engine_descriptor(), engine));
}

}  // namespace grainstep::scene
