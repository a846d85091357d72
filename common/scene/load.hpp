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
#include "grainstep/scene.pb.h"

namespace grainstep::scene {

/// Reads `path` with what it includes, applies `overrides` ("a.b.0.c=VALUE") in order, and fills `message`, whose type
/// is declared with options.proto. `message` is unchanged if an exception is thrown.
/// Returns what was read, which knows where everything was written (origin_of).
declare::Tree load(const std::filesystem::path& path, std::span<const declare::Override> overrides,
                   google::protobuf::Message& message);

/// The same for a scene, and the rules between its keys (rules.hpp).
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, std::span<const declare::Override> overrides);

/// With the overrides of a command line.
[[nodiscard]] Scene load_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

/// XXH3 of the serialised scene: two participants with the same hash compute the same scene.
[[nodiscard]] std::uint64_t scene_hash(const Scene& scene);

/// XXH3 of what sets the scene apart: without its title and without keys at their default. Unlike scene_hash() it stays
/// the same when a later version of the program knows more keys, so that finished runs are recognised.
[[nodiscard]] std::uint64_t essence_hash(const Scene& scene);

}  // namespace grainstep::scene
