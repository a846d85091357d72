/// @file grainstep-docs DIR: writes the documents that are made from the declarations of scenes and studies.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "declare/schema.hpp"
#include "scene/reference.hpp"

namespace {

namespace fs = std::filesystem;
using grainstep::ExitCode;

bool write(const fs::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) std::fprintf(stderr, "grainstep-docs: cannot write %s\n", path.c_str());
  return !stream.fail();
}

bool write_all(const fs::path& folder) {
  namespace declare = grainstep::declare;
  namespace scene = grainstep::scene;
  const auto& study = *grainstep::study::Study::descriptor();
  return write(folder / "scene-reference.md", scene::reference_markdown()) &&
         write(folder / "scene.schema.json", declare::json_schema(*scene::Scene::descriptor())) &&
         write(folder / "study-reference.md", scene::reference_markdown(study, scene::study_head())) &&
         write(folder / "study.schema.json", declare::json_schema(study));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Writes the references and JSON Schemas of scenes and studies, from their declarations in proto/.",
               "grainstep-docs"};
  fs::path folder;
  app.add_option("directory", folder, "Where they are written, usually docs/user")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_input);
  }
  return static_cast<int>(write_all(folder) ? ExitCode::done : ExitCode::output);
}
