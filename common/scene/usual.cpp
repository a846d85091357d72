#include "scene/usual.hpp"

#include <cmath>

#include "base/number_text.hpp"
#include "declare/declaration.hpp"
#include "declare/tree.hpp"
#include "scene/sizes.hpp"

namespace grainstep::scene {
namespace {

using Findings = std::vector<Finding>;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr const char* advice = "; look at its unit and prefix (m is a thousandth, M a million). What is meant may stay";

bool is_unusual(const options::Key& key, double value) {
  const double size = std::abs(value);
  return size > 0.0 &&
         ((key.has_usual_from() && size < key.usual_from()) || (key.has_usual_to() && size > key.usual_to()));
}

void look_at(const FieldDescriptor& field, double value, const std::string& path, Findings& findings) {
  const options::Key& key = declare::key_of(field);
  if (!is_unusual(key, value)) return;
  findings.push_back({Severity::warning, path,
                      "found " + prefixed_text(value, key.unit()) + "; " + key.usual_text() + " are usually " +
                          declare::usual_range(key) + advice});
}

/// Everything that `message` says, down to its last key. Of a list of numbers the first unusual one stands for all.
void walk(const Message& message, const std::string& path, Findings& findings) {
  const auto& reflection = *message.GetReflection();
  std::vector<const FieldDescriptor*> present;
  reflection.ListFields(message, &present);
  for (const FieldDescriptor* field : present) {
    const bool alternative = declare::section_of(*message.GetDescriptor()).scalar_form();
    const std::string at = alternative ? path : declare::join_path(path, field->name());
    const bool section = field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !declare::is_free(*field);
    const bool number = field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE;
    const std::size_t before = findings.size();
    for (int i = 0; field->is_repeated() && i < reflection.FieldSize(message, field); ++i) {
      const std::string item = declare::join_path(at, std::to_string(i));
      if (section) walk(reflection.GetRepeatedMessage(message, field, i), item, findings);
      if (number && findings.size() == before) {
        look_at(*field, reflection.GetRepeatedDouble(message, field, i), item, findings);
      }
    }
    if (field->is_repeated()) continue;
    if (section) walk(reflection.GetMessage(message, field), at, findings);
    if (number) look_at(*field, reflection.GetDouble(message, field), at, findings);
  }
}

/// A contact stiffness over the depth of discs, or over the diameter of spheres, is a modulus; particles are often made
/// softer than their solid, never stiffer.
void contact_is_of_a_solid(const Scene& scene, Findings& findings) {
  constexpr double softest = 1e5;    // Pa, rubber
  constexpr double stiffest = 2e12;  // Pa, diamond
  const Particle& particle = scene.impactor().slug().particle();
  const bool spheres = dimension(scene) == 3;
  const double modulus = particle.normal_stiffness() / (spheres ? particle.diameter() : scene.depth());
  if (modulus >= softest && modulus <= stiffest) return;
  findings.push_back({Severity::warning, "impactor.slug.particle.normal_stiffness",
                      "found " + prefixed_text(particle.normal_stiffness(), "N/m") + ", over the " +
                          (spheres ? "diameter" : "depth") + " a modulus of " + prefixed_text(modulus, "Pa") +
                          "; those of solids are usually " + prefixed_text(softest, "Pa") + " to " +
                          prefixed_text(stiffest, "Pa") + advice});
}

/// DH36's law is one of metals, whatever the keys say.
void metal_is_one(const Layer& layer, const std::string& path, Findings& findings) {
  struct Usual {
    const char* key;
    const char* unit;
    double value, from, to;
  };
  const Usual usual[] = {{"young", "Pa", layer.young(), 10e9, 500e9},
                         {"density", "kg/m^3", layer.density(), 1500.0, 23000.0}};
  for (const auto& [key, unit, value, from, to] : usual) {
    if (value >= from && value <= to) continue;
    findings.push_back({Severity::warning, path + "." + key,
                        "found " + prefixed_text(value, unit) + "; metals usually have " + prefixed_text(from, unit) +
                            " to " + prefixed_text(to, unit) + advice});
  }
}

}  // namespace

void check_usual(const Scene& scene, Findings& findings) {
  const std::size_t before = findings.size();
  walk(scene, "", findings);
  const auto told = [&](const std::string& path) {
    for (std::size_t i = before; i < findings.size(); ++i) {
      if (findings[i].path == path) return true;
    }
    return false;
  };
  Findings of_two_keys;
  if (scene.impactor().has_slug()) contact_is_of_a_solid(scene, of_two_keys);
  for (int i = 0; i < scene.structure().layers_size(); ++i) {
    const Layer& layer = scene.structure().layers(i);
    if (layer.material() == Layer::MATERIAL_DH36) {
      metal_is_one(layer, "structure.layers." + std::to_string(i), of_two_keys);
    }
  }
  for (Finding& finding : of_two_keys) {
    if (!told(finding.path)) findings.push_back(std::move(finding));
  }
}

}  // namespace grainstep::scene
