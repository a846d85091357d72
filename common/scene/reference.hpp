/// @file The reference page of a scene's keys, from its declaration.
#pragma once

#include <string>

#include "grainstep/scene.pb.h"

namespace grainstep::scene {

/// Markdown: a table per section with unit, range, default and symbol of every key.
[[nodiscard]] std::string reference_markdown(const google::protobuf::Descriptor& root = *Scene::descriptor());

}  // namespace grainstep::scene
