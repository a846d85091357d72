/// @file grainstep-docs DIR: writes the documents that are made from the declarations of scenes and studies.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "scene/reference.hpp"
#include "scene/schema.hpp"

namespace {

bool write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) std::fprintf(stderr, "cannot write %s\n", path.c_str());
  return !stream.fail();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: grainstep-docs DIR\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  namespace scene = grainstep::scene;
  const auto& study = *grainstep::study::Study::descriptor();
  const bool written = write(folder / "scene-reference.md", scene::reference_markdown()) &&
                       write(folder / "scene.schema.json", scene::json_schema()) &&
                       write(folder / "study-reference.md", scene::reference_markdown(study, scene::study_head())) &&
                       write(folder / "study.schema.json", scene::json_schema(study));
  return written ? 0 : 2;
}
