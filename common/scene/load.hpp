/// @file From a YAML file to a checked message, and back. The only place where a scene's text is read.
///
/// Exceptions: InputError with everything that is wrong, one line each: "file:line: path.of.key: what was found, what
/// was expected". No text, however broken, has any other effect. Threads: safe, nothing is shared.
#pragma once

#include <google/protobuf/message.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "declare/overrides.hpp"
#include "declare/problems.hpp"
#include "grainstep/scene.pb.h"

namespace grainstep::scene {

/// Reads `path` with what it includes, applies `overrides` ("a.b.0.c=VALUE") in order, and fills `message`, whose type
/// is declared with options.proto. `message` is unchanged if an exception is thrown.
/// Returns what was read, which knows where everything was written (origin_of).
declare::Tree load(const std::filesystem::path& path, std::span<const declare::Override> overrides,
                   google::protobuf::Message& message);

/// A scene's file with what it includes, read once for any number of scenes that differ in their overrides.
class SceneFile {
 public:
  explicit SceneFile(const std::filesystem::path& path);

  /// As load(), and the rules between the scene's keys (rules.hpp).
  [[nodiscard]] Scene with(std::span<const declare::Override> overrides) const;

 private:
  declare::Problems problems_;
  declare::Tree tree_;
};

/// The same for one scene.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, std::span<const declare::Override> overrides);

/// With the overrides of a command line.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

/// XXH3 of the serialised scene: two participants with the same hash compute the same scene.
[[nodiscard]] std::uint64_t scene_hash(const Scene& scene);

/// XXH3 of what sets the scene apart: without its title and without keys at their default. Unlike scene_hash() it stays
/// the same when a later version of the program knows more keys, so that finished runs are recognised.
[[nodiscard]] std::uint64_t essence_hash(const Scene& scene);

}  // namespace grainstep::scene
