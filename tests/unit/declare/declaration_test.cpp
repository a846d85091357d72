/// @file Every key of the scene is declared completely: what the loader and the documents rely on.
#include "declare/declaration.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "declare/problems.hpp"
#include "declare/read.hpp"
#include "grainstep/scene.pb.h"
#include "units/quantity.hpp"

namespace grainstep::declare {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

void collect(const Descriptor& message, std::set<const Descriptor*>& all) {
  if (!all.insert(&message).second) return;
  for (int i = 0; i < message.field_count(); ++i) {
    if (message.field(i)->message_type() == nullptr || is_free(*message.field(i))) continue;
    collect(*message.field(i)->message_type(), all);
  }
}

std::set<const Descriptor*> all_sections() {
  std::set<const Descriptor*> all;
  collect(*scene::Scene::descriptor(), all);
  return all;
}

/// A key that may be absent and has no default must be able to say that it is absent (or be a text, where that is "").
bool can_be_absent(const FieldDescriptor& field) {
  const auto& key = key_of(field);
  return key.required() || !key.default_value().empty() || field.has_presence() || field.is_repeated() ||
         field.cpp_type() == FieldDescriptor::CPPTYPE_STRING;
}

TEST(Declaration, EveryKeyIsDocumentedAndItsUnitKnown) {
  for (const auto* section : all_sections()) {
    EXPECT_FALSE(section_of(*section).text().empty()) << section->full_name();
    for (int i = 0; i < section->field_count(); ++i) {
      const FieldDescriptor& field = *section->field(i);
      EXPECT_FALSE(key_of(field).text().empty()) << field.full_name();
      EXPECT_TRUE(units::is_unit(key_of(field).unit())) << field.full_name();
      EXPECT_TRUE(can_be_absent(field)) << field.full_name();
      EXPECT_FALSE(key_of(field).required() && !key_of(field).default_value().empty()) << field.full_name();
      if (field.enum_type() == nullptr) continue;
      for (const auto& word : words_of(*field.enum_type())) EXPECT_FALSE(word.text.empty()) << field.full_name();
    }
  }
}

TEST(Declaration, SectionsWithoutRequiredKeysReadFromNothing) {
  Tree nothing;
  nothing.kind = Tree::Kind::map;
  Problems problems;
  scene::Steps steps;
  scene::Guards guards;
  scene::Output output;
  scene::SurfaceContact contact;
  scene::Mesh mesh;
  for (google::protobuf::Message* section :
       std::initializer_list<google::protobuf::Message*>{&steps, &guards, &output, &contact, &mesh}) {
    read_message(nothing, "", *section, problems);
  }
  EXPECT_NO_THROW(problems.throw_if_any());
}

/// Every symbol with the path of its key, in the notation table.
void expect_in_notation(const std::string& notation, const Descriptor& section, const std::string& path) {
  for (int i = 0; i < section.field_count(); ++i) {
    const FieldDescriptor& field = *section.field(i);
    const bool alternative = section_of(section).scalar_form();
    const std::string key = alternative ? path : join_path(path, field.name()) + (field.is_repeated() ? ".N" : "");
    const std::string& symbol = key_of(field).symbol();
    const std::string column = "`" + section.name() + "." + field.name() + "`";
    bool found = symbol.empty();
    std::istringstream lines(notation);
    for (std::string line; std::getline(lines, line) && !found;) {
      found = line.starts_with("| `" + symbol + "` |") && line.find("`" + key + "`") != std::string::npos &&
              line.find(column) != std::string::npos;
    }
    EXPECT_TRUE(found) << "docs/theory/notation.md has no row for " << symbol << ", " << key << ", " << column;
    if (field.message_type() != nullptr && !is_free(field)) expect_in_notation(notation, *field.message_type(), key);
  }
}

TEST(Declaration, EverySymbolIsInTheNotationTable) {
  std::ostringstream notation;
  notation << std::ifstream(GRAINSTEP_SOURCE_DIR "/docs/theory/notation.md").rdbuf();
  expect_in_notation(notation.str(), *scene::Scene::descriptor(), "");
}

}  // namespace
}  // namespace grainstep::declare
