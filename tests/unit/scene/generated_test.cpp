/// @file The committed documents are the ones that the declaration gives.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "declare/schema.hpp"
#include "scene/reference.hpp"

namespace grainstep::scene {
namespace {

const std::filesystem::path user_docs = std::filesystem::path(GRAINSTEP_SOURCE_DIR) / "docs" / "user";

std::string committed(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(user_docs / name, std::ios::binary).rdbuf();
  return text.str();
}

constexpr auto advice = "is stale: run build/bin/grainstep-docs docs/user";

TEST(Generated, ReferencePageIsFresh) {
  EXPECT_TRUE(committed("scene-reference.md") == reference_markdown()) << "docs/user/scene-reference.md " << advice;
}

TEST(Generated, SchemaIsFresh) {
  EXPECT_TRUE(committed("scene.schema.json") == declare::json_schema(*scene::Scene::descriptor()))
      << "docs/user/scene.schema.json " << advice;
}

TEST(Generated, StudyDocumentsAreFresh) {
  const auto& study = *study::Study::descriptor();
  EXPECT_TRUE(committed("study-reference.md") == reference_markdown(study, study_head()))
      << "docs/user/study-reference.md " << advice;
  EXPECT_TRUE(committed("study.schema.json") == declare::json_schema(study))
      << "docs/user/study.schema.json " << advice;
}

TEST(Generated, SchemaSaysWhatTheDeclarationSays) {
  const auto schema = nlohmann::json::parse(declare::json_schema(*scene::Scene::descriptor()));
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
  EXPECT_TRUE(schema["properties"].contains("include"));
  const auto& particle = schema["definitions"]["grainstep.scene.Particle"];
  EXPECT_EQ(particle["additionalProperties"], false);
  const auto& diameter = particle["properties"]["diameter"];
  EXPECT_EQ(diameter["anyOf"][0]["exclusiveMinimum"], 0.0);
  EXPECT_EQ(diameter["anyOf"][1]["type"], "string");
  EXPECT_EQ(schema["definitions"]["grainstep.scene.Steps"]["properties"]["impactor"]["anyOf"].size(), 3);
}

}  // namespace
}  // namespace grainstep::scene
