#include "declare/declaration.hpp"

#include <google/protobuf/struct.pb.h>

#include <cctype>

#include "base/assert.hpp"
#include "base/number_text.hpp"
#include "declare/suggest.hpp"

namespace grainstep::declare {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;

const options::Key& key_of(const FieldDescriptor& field) { return field.options().GetExtension(options::key); }

const options::Section& section_of(const Descriptor& message) {
  return message.options().GetExtension(options::section);
}

bool is_free(const FieldDescriptor& field) { return field.message_type() == google::protobuf::Struct::descriptor(); }

bool is_section(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !is_free(field) &&
         !section_of(*field.message_type()).scalar_form();
}

std::vector<Word> words_of(const EnumDescriptor& type) {
  const std::string suffix = "UNSET";
  const std::string& unset = type.value(0)->name();
  GS_ASSERT(unset.ends_with(suffix), type.full_name() + " has no ..._UNSET value");
  const std::size_t prefix = unset.size() - suffix.size();
  std::vector<Word> words;
  for (int i = 1; i < type.value_count(); ++i) {
    Word word{type.value(i)->name().substr(prefix), type.value(i)->number(),
              type.value(i)->options().GetExtension(options::word_text)};
    for (char& c : word.word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    words.push_back(std::move(word));
  }
  return words;
}

std::vector<std::string> word_names(const EnumDescriptor& type) {
  std::vector<std::string> names;
  for (auto& word : words_of(type)) names.push_back(std::move(word.word));
  return names;
}

std::string word_for(const EnumDescriptor& type, int number) {
  for (auto& word : words_of(type)) {
    if (word.number == number) return std::move(word.word);
  }
  return {};
}

std::vector<std::string> key_names(const Descriptor& message) {
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(message.field_count()));
  for (int i = 0; i < message.field_count(); ++i) names.push_back(message.field(i)->name());
  return names;
}

std::vector<const FieldDescriptor*> alternatives(const Descriptor& message) {
  GS_ASSERT(message.real_oneof_decl_count() == 1, message.full_name() + " has a scalar form but not one oneof");
  std::vector<const FieldDescriptor*> members;
  const auto* oneof = message.oneof_decl(0);
  members.reserve(static_cast<std::size_t>(oneof->field_count()));
  for (int i = 0; i < oneof->field_count(); ++i) members.push_back(oneof->field(i));
  return members;
}

std::string expected_section(const Descriptor& message) {
  if (!section_of(message).scalar_form()) return "a map of keys (" + join_words(key_names(message)) + ")";
  std::string text;
  for (const auto* member : alternatives(message)) {
    text += (text.empty() ? "" : ", or ") + expected_value(*member) + " (" + key_of(*member).text() + ")";
  }
  return text;
}

std::string expected_value(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_FLOAT:
      return key_of(field).unit().empty() ? std::string("a pure number")
                                          : "a number with a unit of " + key_of(field).unit();
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_ENUM: {
      const auto names = word_names(*field.enum_type());
      return (names.size() == 1 ? "" : "one of ") + join_words(names);
    }
    case FieldDescriptor::CPPTYPE_STRING:
      return "a text";
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return is_free(field) ? std::string("a map of keys") : expected_section(*field.message_type());
    default:
      return "a whole number";
  }
}

std::string range_text(const options::Key& key) {
  std::vector<std::string> bounds;
  if (key.has_above()) bounds.push_back("above " + number_text(key.above()));
  if (key.has_min()) bounds.push_back("at least " + number_text(key.min()));
  if (key.has_below()) bounds.push_back("below " + number_text(key.below()));
  if (key.has_max()) bounds.push_back("at most " + number_text(key.max()));
  return join_words(bounds);
}

std::string usual_range(const options::Key& key) {
  if (!key.has_usual_from() && !key.has_usual_to()) return {};
  const std::string from = prefixed_text(key.usual_from(), key.unit());
  const std::string to = prefixed_text(key.usual_to(), key.unit());
  if (!key.has_usual_to()) return "at least " + from;
  return key.has_usual_from() ? from + " to " + to : "at most " + to;
}

std::string usual_sentence(const options::Key& key) {
  const std::string range = usual_range(key);
  return range.empty() ? range : " Usual: " + range + ".";
}

}  // namespace grainstep::declare
