/// @file Scenes for tests: files in a directory of their own, and what loading them says.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "scene/load.hpp"

namespace grainstep::scene {

/// The shortest valid scene.
inline const std::string minimal_scene = R"(time: { end: 1.5 }
impactor:
  slug:
    half_width: 0.1 m
    height: 0.3 m
    relative_density: 0.2
    speed: 400 m/s
    particle:
      diameter: 200 um
      density: 2700 kg/m^3
      normal_stiffness: 7300 kN/m
      restitution: 0.7
structure:
  half_span: 0.5 m
  layers:
    - { material: dh36, thickness: 50 mm }
)";

/// A directory of this test's own, removed with it.
class SceneFiles {
 public:
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    auto path = folder() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return directory_.path(); }

 private:
  TemporaryDirectory directory_;
};

/// The message of the InputError that loading gives, without the directory's name; "accepted" if there is none.
inline std::string load_error(const SceneFiles& files, const std::filesystem::path& path,
                              const std::vector<std::string>& overrides = {}) {
  try {
    static_cast<void>(load_scene(path, overrides));
  } catch (const InputError& error) {
    std::string text = error.what();
    const std::string folder = files.folder().string() + "/";
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder)) text.erase(at, folder.size());
    return text;
  }
  return "accepted";
}

inline std::string load_error(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  const SceneFiles files;
  return load_error(files, files.write("x.yaml", scene), overrides);
}

inline Scene load_text(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  const SceneFiles files;
  return load_scene(files.write("x.yaml", scene), overrides);
}

/// `text` with its one occurrence of `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("'" + from + "' is not in the scene");
  return text.replace(at, from.size(), to);
}

}  // namespace grainstep::scene
