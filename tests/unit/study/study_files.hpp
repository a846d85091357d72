/// @file Studies for tests: a small scene and study files beside it, and what loading them says.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.hpp"
#include "base/temporary_directory.hpp"
#include "orchestrator/record/summary.hpp"
#include "orchestrator/study/outcome.hpp"
#include "orchestrator/study/plan.hpp"

namespace grainstep::study {

inline const std::string small_scene = R"(time: { end: 0.01 }
impactor:
  slug:
    half_width: 0.1 m
    height: 0.3 m
    relative_density: 0.2
    speed: 400 m/s
    particle: { diameter: 8 mm, density: 2700 kg/m^3, normal_stiffness: 7300 kN/m, restitution: 0.7 }
structure:
  half_span: 0.5 m
  mesh: { refinement: 2 }
  layers: [{ material: dh36, thickness: 50 mm }]
)";

class StudyFiles {
 public:
  StudyFiles() { write("scene.yaml", small_scene); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto path = folder() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  /// `text` after title and scene.
  [[nodiscard]] Plan plan(const std::string& text) const {
    return load_plan(write("study.yaml", "title: T\nscene: scene.yaml\n" + text));
  }

  /// What is wrong with it, without the directory's name.
  [[nodiscard]] std::string error(const std::string& text) const {
    try {
      static_cast<void>(plan(text));
    } catch (const InputError& error) {
      std::string out = error.what();
      const std::string prefix = folder().string() + "/";
      for (auto at = out.find(prefix); at != std::string::npos; at = out.find(prefix)) out.erase(at, prefix.size());
      return out;
    }
    return "accepted";
  }

  /// A run as it would be found: its summary only.
  void leave_run(const std::string& directory, const std::string& key, const std::string& status = "done",
                 int exit_code = 0, double peak = 0.1, int version = orchestrator::results_version) const {
    const nlohmann::ordered_json summary = {{"status", status},          {"reason", status == "done" ? "" : "because"},
                                            {"exit_code", exit_code},    {"peak_deflection", peak},
                                            {"early_pressure", nullptr}, {"wall_split", {{"impactor_wait", 0.25}}},
                                            {"scene_key", key},          {"results_version", version}};
    write(directory + "/summary.json", summary.dump());
  }

  [[nodiscard]] std::filesystem::path folder() const { return directory_.path(); }

 private:
  TemporaryDirectory directory_;
};

}  // namespace grainstep::study
