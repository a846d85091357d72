#include "scene/load.hpp"

#include <memory>
#include <vector>

#include "scene/core.hpp"
#include "scene/include.hpp"
#include "scene/overrides.hpp"
#include "scene/problems.hpp"
#include "scene/read.hpp"
#include "scene/rules.hpp"

namespace grainstep::scene {
using google::protobuf::Message;

Tree load(const std::filesystem::path& path, std::span<const Override> overrides, Message& message) {
  Problems problems;
  Tree tree = read_file(path, problems);
  for (const auto& one : overrides) apply_override(tree, one, problems);
  const std::unique_ptr<Message> read(message.New());
  read_message(tree, "", *read, problems);
  problems.throw_if_any();
  message.GetReflection()->Swap(&message, read.get());
  return tree;
}

Scene load_scene(const std::filesystem::path& path, std::span<const Override> overrides) {
  Scene scene;
  const Tree tree = load(path, overrides, scene);
  Problems problems;
  for (const auto& finding : check_rules(scene)) {
    if (finding.severity == Severity::error) problems.add(origin_of(tree, finding.path), finding.path, finding.text);
  }
  problems.throw_if_any();
  resolve_cores(scene);
  return scene;
}

Scene load_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
  std::vector<Override> of_command_line;
  for (const auto& text : overrides) of_command_line.push_back({.text = text});
  return load_scene(path, of_command_line);
}

}  // namespace grainstep::scene
