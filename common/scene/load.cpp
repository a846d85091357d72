#include "scene/load.hpp"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <xxhash.h>

#include <memory>

#include "scene/include.hpp"
#include "scene/overrides.hpp"
#include "scene/problems.hpp"
#include "scene/read.hpp"
#include "scene/rules.hpp"

namespace grainstep::scene {
namespace {

using google::protobuf::Message;

/// Returns the tree too: it knows where everything was written.
Tree load_tree(const std::filesystem::path& path, std::span<const std::string> overrides, Message& message) {
  Problems problems;
  Tree tree = read_file(path, problems);
  for (const auto& text : overrides) apply_override(tree, text, problems);
  const std::unique_ptr<Message> read(message.New());
  read_message(tree, "", *read, problems);
  problems.throw_if_any();
  message.GetReflection()->Swap(&message, read.get());
  return tree;
}

}  // namespace

void load(const std::filesystem::path& path, std::span<const std::string> overrides, Message& message) {
  static_cast<void>(load_tree(path, overrides, message));
}

Scene load_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
  Scene scene;
  const Tree tree = load_tree(path, overrides, scene);
  Problems problems;
  for (const auto& finding : check_rules(scene)) {
    if (finding.severity == Severity::error) problems.add(origin_of(tree, finding.path), finding.path, finding.text);
  }
  problems.throw_if_any();
  return scene;
}

std::uint64_t scene_hash(const Scene& scene) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    scene.SerializeToCodedStream(&coded);
  }
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace grainstep::scene
