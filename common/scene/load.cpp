#include "scene/load.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "declare/include.hpp"
#include "declare/overrides.hpp"
#include "declare/problems.hpp"
#include "declare/read.hpp"
#include "declare/suggest.hpp"
#include "grainstep/study.pb.h"
#include "scene/core.hpp"
#include "scene/rules.hpp"

namespace grainstep::scene {
using google::protobuf::Message;

namespace {

std::vector<std::string> known_of(const declare::Tree& tree, const google::protobuf::Descriptor& kind) {
  std::vector<std::string> known;
  for (const auto& [name, member] : tree.members) {
    if (kind.FindFieldByName(name) != nullptr) known.push_back(name);
  }
  return known;
}

/// A study where a scene belongs, or a scene for a study: a list of unknown keys would not say so.
void refuse_other_kind(const declare::Tree& tree, const std::string& file, const google::protobuf::Descriptor& wanted) {
  const bool scene = &wanted == Scene::descriptor();
  if (!scene && &wanted != study::Study::descriptor()) return;
  const auto& other = scene ? *study::Study::descriptor() : *Scene::descriptor();
  const auto of_other = known_of(tree, other);
  if (of_other.size() <= known_of(tree, wanted).size()) return;
  const std::string advice = scene ? "a study, not a scene: use grainstep study " + file
                                   : "a scene, not a study: use grainstep run " + file + ", or grainstep check";
  throw InputError(file + ": is " + advice + " (it has the keys " + declare::join_words(of_other) + ")");
}

/// `problems`: those of the file.
void fill(declare::Tree& tree, declare::Problems problems, std::span<const declare::Override> overrides,
          Message& message) {
  for (const auto& one : overrides) declare::apply_override(tree, one, problems);
  const std::unique_ptr<Message> read(message.New());
  declare::read_message(tree, "", *read, problems);
  problems.throw_if_any();
  message.GetReflection()->Swap(&message, read.get());
}

}  // namespace

declare::Tree load(const std::filesystem::path& path, std::span<const declare::Override> overrides, Message& message) {
  declare::Problems problems;
  declare::Tree tree = declare::read_file(path, problems);
  refuse_other_kind(tree, path.string(), *message.GetDescriptor());
  fill(tree, std::move(problems), overrides, message);
  return tree;
}

SceneFile::SceneFile(const std::filesystem::path& path) : tree_(declare::read_file(path, problems_)) {
  refuse_other_kind(tree_, path.string(), *Scene::descriptor());
}

Scene SceneFile::with(std::span<const declare::Override> overrides) const {
  Scene scene;
  declare::Tree tree = tree_;
  fill(tree, problems_, overrides, scene);
  declare::Problems problems;
  for (const auto& finding : check_rules(scene)) {
    if (finding.severity == Severity::error)
      problems.add(declare::origin_of(tree, finding.path), finding.path, finding.text);
  }
  problems.throw_if_any();
  resolve_cores(scene);
  return scene;
}

Scene load_scene(const std::filesystem::path& path, std::span<const declare::Override> overrides) {
  return SceneFile(path).with(overrides);
}

Scene load_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
  std::vector<declare::Override> of_command_line;
  for (const auto& text : overrides) of_command_line.push_back({.text = text});
  return load_scene(path, of_command_line);
}

}  // namespace grainstep::scene
