/// @file The reference page of the keys of a file (a scene, a study), from its declaration.
#pragma once

#include <string>

#include "grainstep/scene.pb.h"
#include "grainstep/study.pb.h"

namespace grainstep::scene {

/// What stands above the tables: a heading and an introduction.
struct ReferenceHead {
  std::string heading;
  std::string introduction;
};
[[nodiscard]] const ReferenceHead& scene_head();
[[nodiscard]] const ReferenceHead& study_head();

/// Markdown: a table per section with unit, range, default and symbol of every key.
[[nodiscard]] std::string reference_markdown(const google::protobuf::Descriptor& root = *Scene::descriptor(),
                                             const ReferenceHead& head = scene_head());

}  // namespace grainstep::scene
