#include "declare/schema.hpp"

#include <nlohmann/json.hpp>

#include "declare/declaration.hpp"

namespace grainstep::declare {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using Json = nlohmann::ordered_json;

Json with_bounds(Json number, const options::Key& key) {
  if (key.has_min()) number["minimum"] = key.min();
  if (key.has_max()) number["maximum"] = key.max();
  if (key.has_above()) number["exclusiveMinimum"] = key.above();
  if (key.has_below()) number["exclusiveMaximum"] = key.below();
  return number;
}

/// A number, or a number with a unit as a text. Bounds hold for the bare number, which is SI.
Json quantity(const options::Key& key) {
  const Json number = with_bounds({{"type", "number"}}, key);
  const Json text = {{"type", "string"}, {"pattern", "^\\s*[-+]?(\\d|\\.\\d)"}};
  return {{"anyOf", Json::array({number, text})}};
}

Json words(const google::protobuf::EnumDescriptor& type) {
  Json all = Json::array();
  for (const auto& word : words_of(type)) all.push_back({{"const", word.word}, {"description", word.text}});
  return {{"oneOf", all}};
}

Json value_schema(const FieldDescriptor& field);

Json alternative_schema(const Descriptor& message) {
  Json any = Json::array();
  for (const auto* member : alternatives(message)) {
    Json choice = value_schema(*member);
    choice["description"] = key_of(*member).text() + "." + usual_sentence(key_of(*member));
    any.push_back(choice);
  }
  return {{"anyOf", any}};
}

Json value_schema(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_FLOAT:
      return quantity(key_of(field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return {{"type", "boolean"}};
    case FieldDescriptor::CPPTYPE_ENUM:
      return words(*field.enum_type());
    case FieldDescriptor::CPPTYPE_STRING:
      return {{"type", Json::array({"string", "number", "boolean"})}};
    case FieldDescriptor::CPPTYPE_MESSAGE:
      if (is_free(field)) return {{"type", "object"}};
      if (section_of(*field.message_type()).scalar_form()) return alternative_schema(*field.message_type());
      return {{"allOf", Json::array({{{"$ref", "#/definitions/" + field.message_type()->full_name()}}})}};
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_UINT64: {
      Json integer = with_bounds({{"type", "integer"}}, key_of(field));
      if (!integer.contains("minimum")) integer["minimum"] = 0;
      return integer;
    }
    default:
      return with_bounds({{"type", "integer"}}, key_of(field));
  }
}

std::string description(const FieldDescriptor& field) {
  const auto& key = key_of(field);
  std::string text = key.text();
  if (!key.unit().empty()) text += " SI unit: " + key.unit() + ".";
  if (!key.symbol().empty()) text += " Symbol: " + key.symbol() + ".";
  if (key.required()) text += " Required.";
  text += usual_sentence(key);
  if (!key.default_value().empty() && key.default_value() != "{}") text += " Default: " + key.default_value() + ".";
  return text;
}

Json field_schema(const FieldDescriptor& field) {
  Json schema = value_schema(field);
  if (field.is_repeated()) {
    schema = {{"type", "array"}, {"items", schema}};
    if (key_of(field).has_min_items()) schema["minItems"] = key_of(field).min_items();
  }
  schema["description"] = description(field);
  return schema;
}

Json object_schema(const Descriptor& message) {
  Json properties = Json::object();
  for (int i = 0; i < message.field_count(); ++i)
    properties[message.field(i)->name()] = field_schema(*message.field(i));
  return {{"type", "object"},
          {"description", section_of(message).text()},
          {"properties", properties},
          {"additionalProperties", false}};
}

void define(const Descriptor& message, Json& definitions) {
  for (int i = 0; i < message.field_count(); ++i) {
    const auto* part = message.field(i)->message_type();
    if (part == nullptr || !is_section(*message.field(i)) || definitions.contains(part->full_name())) continue;
    definitions[part->full_name()] = object_schema(*part);
    define(*part, definitions);
  }
}

}  // namespace

std::string json_schema(const Descriptor& root) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"$comment", "Written by grainstep-docs; do not edit."},
                 {"title", root.full_name()}};
  schema.update(object_schema(root));
  const Json path = {{"type", "string"}};
  schema["properties"]["include"] = {
      {"anyOf", Json::array({path, {{"type", "array"}, {"items", path}}})},
      {"description", "Files (relative to this one) on which this one builds; keys written here override theirs."}};
  Json definitions = Json::object();
  define(root, definitions);
  schema["definitions"] = definitions;
  return schema.dump(2) + "\n";
}

}  // namespace grainstep::declare
