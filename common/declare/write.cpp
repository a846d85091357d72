#include "declare/write.hpp"

#include "base/assert.hpp"
#include "base/number_text.hpp"
#include "declare/declaration.hpp"
#include "declare/free_settings.hpp"
#include "declare/quoted.hpp"

namespace grainstep::declare {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Lines = std::vector<std::string>;

/// One value of `field`; `index` counts the items of a repeated field and is ignored otherwise. Empty: nothing to
/// write.
std::string scalar_text(const Message& message, const FieldDescriptor& field, int index) {
  const auto& r = *message.GetReflection();
  const bool list = field.is_repeated();
  const std::string unit = key_of(field).unit().empty() ? "" : " " + key_of(field).unit();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return number_text(list ? r.GetRepeatedDouble(message, &field, index) : r.GetDouble(message, &field)) + unit;
    case FieldDescriptor::CPPTYPE_UINT32:
      return std::to_string(list ? r.GetRepeatedUInt32(message, &field, index) : r.GetUInt32(message, &field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return std::to_string(list ? r.GetRepeatedUInt64(message, &field, index) : r.GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_INT32:
      return std::to_string(list ? r.GetRepeatedInt32(message, &field, index) : r.GetInt32(message, &field));
    case FieldDescriptor::CPPTYPE_INT64:
      return std::to_string(list ? r.GetRepeatedInt64(message, &field, index) : r.GetInt64(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return (list ? r.GetRepeatedBool(message, &field, index) : r.GetBool(message, &field)) ? "true" : "false";
    case FieldDescriptor::CPPTYPE_ENUM:
      return word_for(*field.enum_type(),
                      list ? r.GetRepeatedEnumValue(message, &field, index) : r.GetEnumValue(message, &field));
    case FieldDescriptor::CPPTYPE_STRING:
      return quoted(list ? r.GetRepeatedString(message, &field, index) : r.GetString(message, &field));
    default:
      assertion_failed("known type", __FILE__, __LINE__, field.full_name() + " has a type that no scene can hold");
  }
}

Lines section_lines(const Message& message);

/// "key: value", or "key:" above the indented lines of a section.
Lines labelled(const std::string& label, const Message& part) {
  const auto& descriptor = *part.GetDescriptor();
  if (section_of(descriptor).scalar_form()) {
    const auto* member = part.GetReflection()->GetOneofFieldDescriptor(part, descriptor.oneof_decl(0));
    return member == nullptr ? Lines{} : Lines{label + ": " + scalar_text(part, *member, 0)};
  }
  const Lines inner = section_lines(part);
  Lines lines{label + (inner.empty() ? ": {}" : ":")};
  for (const auto& line : inner) lines.push_back("  " + line);
  return lines;
}

/// The items of a list of sections: "  - key: value", continued with four blanks.
Lines section_list(const Message& message, const FieldDescriptor& field) {
  Lines lines{field.name() + ":"};
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
    Lines item = section_lines(reflection.GetRepeatedMessage(message, &field, i));
    if (item.empty()) item.emplace_back("{}");
    for (std::size_t k = 0; k < item.size(); ++k) lines.push_back((k == 0 ? "  - " : "    ") + item[k]);
  }
  return lines;
}

Lines list_lines(const Message& message, const FieldDescriptor& field) {
  const int size = message.GetReflection()->FieldSize(message, &field);
  if (size > 0 && field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) return section_list(message, field);
  std::string items;
  for (int i = 0; i < size; ++i) items += (i == 0 ? "" : ", ") + scalar_text(message, field, i);
  return {field.name() + ": [" + items + "]"};
}

Lines field_lines(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  if (field.is_repeated()) return list_lines(message, field);
  if (field.has_presence() && !reflection.HasField(message, &field)) return {};
  if (is_free(field)) {
    const auto& settings = static_cast<const google::protobuf::Struct&>(reflection.GetMessage(message, &field));
    return {field.name() + ": " + to_yaml(settings)};
  }
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
    return labelled(field.name(), reflection.GetMessage(message, &field));
  }
  const std::string text = scalar_text(message, field, 0);
  return text.empty() ? Lines{} : Lines{field.name() + ": " + text};
}

Lines section_lines(const Message& message) {
  Lines lines;
  const auto& descriptor = *message.GetDescriptor();
  for (int i = 0; i < descriptor.field_count(); ++i) {
    for (auto& line : field_lines(message, *descriptor.field(i))) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

std::string to_yaml(const Message& message) {
  std::string text;
  for (const auto& line : section_lines(message)) text += line + "\n";
  return text;
}

}  // namespace grainstep::declare
