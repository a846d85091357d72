#include "scene/reference.hpp"

#include <deque>
#include <utility>

#include "declare/declaration.hpp"
#include "declare/tree.hpp"

namespace grainstep::scene {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

/// A bar would begin the next column.
std::string in_a_table(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "&#124;" : std::string(1, c);
  return out;
}

std::string type_text(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_FLOAT:
      return "number";
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_ENUM:
      return "word";
    case FieldDescriptor::CPPTYPE_STRING:
      return "text";
    case FieldDescriptor::CPPTYPE_MESSAGE:
      if (declare::is_free(field)) return "any keys";
      return declare::is_section(field) ? "section" : "see below";
    default:
      return "whole number";
  }
}

std::string default_text(const FieldDescriptor& field) {
  const auto& key = declare::key_of(field);
  if (key.required()) return "**required**";
  if (key.default_value().empty()) return "-";
  return declare::is_section(field) ? "its own" : code(key.default_value());
}

std::string row(const FieldDescriptor& field) {
  const auto& key = declare::key_of(field);
  const std::string type = (field.is_repeated() ? "list of " : "") + type_text(field);
  return "| " + code(field.name()) + " | " + type + " | " + code(key.unit()) + " | " + declare::range_text(key) +
         " | " + default_text(field) + " | " + code(key.symbol()) + " | " + in_a_table(key.text()) +
         declare::usual_sentence(key) + " |\n";
}

/// What may stand for a key that is neither a number nor a section: its words, or its alternatives.
std::string choices(const FieldDescriptor& field) {
  std::string text;
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    for (const auto& word : declare::words_of(*field.enum_type()))
      text += "  - " + code(word.word) + ": " + word.text + "\n";
  } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !declare::is_section(field) &&
             !declare::is_free(field)) {
    for (const auto* member : declare::alternatives(*field.message_type())) {
      const std::string range = declare::range_text(declare::key_of(*member));
      const bool word = member->cpp_type() == FieldDescriptor::CPPTYPE_ENUM;
      const std::string form = word ? code(declare::expected_value(*member)) : declare::expected_value(*member);
      text += "  - " + form + ": " + declare::key_of(*member).text() + (range.empty() ? "" : " (" + range + ")") + "." +
              declare::usual_sentence(declare::key_of(*member)) + "\n";
    }
  }
  return text.empty() ? text : "- " + code(field.name()) + " is one of\n" + text;
}

std::string section_text(const std::string& path, const Descriptor& message) {
  std::string text = "## " + (path.empty() ? std::string("Top level") : code(path)) + "\n\n";
  text += declare::section_of(message).text() + "\n\n";
  text += "| key | value | SI unit | range | default | symbol | meaning |\n";
  text += "|---|---|---|---|---|---|---|\n";
  std::string words;
  for (int i = 0; i < message.field_count(); ++i) {
    text += row(*message.field(i));
    words += choices(*message.field(i));
  }
  return text + (words.empty() ? "" : "\n" + words) + "\n";
}

}  // namespace

const ReferenceHead& scene_head() {
  static const ReferenceHead head{"Scene reference",
                                  "Every key that a scene may hold. A number may carry any unit that converts to the "
                                  "SI unit given here (`200 um`,\n"
                                  "`7300 kN/m`); a bare number is SI. Symbols are those of [the notation "
                                  "table](../theory/notation.md). How scenes\n"
                                  "are written, included and overridden: [writing a scene](writing-a-scene.md).\n\n"};
  return head;
}

const ReferenceHead& study_head() {
  static const ReferenceHead head{
      "Study reference",
      "Every key that a study file may hold; [studies](studies.md) says what is made of them. Files are read as scenes "
      "are\n"
      "([writing a scene](writing-a-scene.md)): `include` works, unknown keys are errors.\n\n"};
  return head;
}

std::string reference_markdown(const Descriptor& root, const ReferenceHead& head) {
  std::string text = "# " + head.heading + "\n\n<!-- Written by grainstep-docs from proto/grainstep/" +
                     root.file()->name().substr(root.file()->name().rfind('/') + 1) + "; do not edit. -->\n\n" +
                     head.introduction;
  std::deque<std::pair<std::string, const Descriptor*>> open{{"", &root}};
  while (!open.empty()) {
    const auto [path, message] = open.front();
    open.pop_front();
    text += section_text(path, *message);
    std::deque<std::pair<std::string, const Descriptor*>> parts;
    for (int i = 0; i < message->field_count(); ++i) {
      const FieldDescriptor& field = *message->field(i);
      const std::string name = field.name() + (field.is_repeated() ? ".N" : "");
      if (declare::is_section(field)) parts.emplace_back(declare::join_path(path, name), field.message_type());
    }
    open.insert(open.begin(), parts.begin(), parts.end());
  }
  text.pop_back();
  return text;
}

}  // namespace grainstep::scene
