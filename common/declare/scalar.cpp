#include "declare/scalar.hpp"

#include <charconv>
#include <nlohmann/json.hpp>

#include "base/assert.hpp"
#include "base/error.hpp"
#include "declare/declaration.hpp"
#include "declare/suggest.hpp"
#include "units/quantity.hpp"

namespace grainstep::declare {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

[[noreturn]] void fail_type(const Tree& node, const FieldDescriptor& field) {
  throw InputError(node.description() + " is not " + expected_value(field));
}

void check_range(const Tree& node, const FieldDescriptor& field, double value) {
  const auto& key = key_of(field);
  const bool inside = (!key.has_above() || value > key.above()) && (!key.has_min() || value >= key.min()) &&
                      (!key.has_below() || value < key.below()) && (!key.has_max() || value <= key.max());
  if (inside) return;
  throw InputError(node.description() + " is out of range: it must be " + range_text(key) +
                   (key.unit().empty() ? "" : " " + key.unit()));
}

template <typename Integer>
Integer parse_integer(const Tree& node, const FieldDescriptor& field) {
  Integer value = 0;
  const char* const end = node.scalar.data() + node.scalar.size();
  const auto [stop, error] = std::from_chars(node.scalar.data(), end, value);
  if (error == std::errc::result_out_of_range) throw InputError(node.description() + " is too large");
  if (error != std::errc() || stop != end) fail_type(node, field);
  check_range(node, field, static_cast<double>(value));
  return value;
}

double parse_double(const Tree& node, const FieldDescriptor& field) {
  const double value = units::parse_quantity(node.scalar, key_of(field).unit());
  check_range(node, field, value);
  return value;
}

bool parse_bool(const Tree& node, const FieldDescriptor& field) {
  if (node.scalar == "true") return true;
  if (node.scalar != "false") fail_type(node, field);
  return false;
}

int parse_word(const Tree& node, const FieldDescriptor& field) {
  for (const auto& word : words_of(*field.enum_type())) {
    if (word.word == node.scalar) return word.number;
  }
  throw InputError(node.description() + " is not " + expected_value(field) +
                   hint(node.scalar, word_names(*field.enum_type())));
}

const std::string& parse_text(const Tree& node) {
  try {
    static_cast<void>(nlohmann::json(node.scalar).dump());
  } catch (const nlohmann::json::exception&) {
    throw InputError("a text that is not UTF-8");
  }
  return node.scalar;
}

}  // namespace

void set_scalar(const Tree& node, Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  const bool list = field.is_repeated();
  const auto put = [&](auto set, auto add, auto value) {
    (reflection.*(list ? add : set))(&message, &field, std::move(value));
  };
  using R = google::protobuf::Reflection;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return put(&R::SetDouble, &R::AddDouble, parse_double(node, field));
    case FieldDescriptor::CPPTYPE_UINT32:
      return put(&R::SetUInt32, &R::AddUInt32, parse_integer<std::uint32_t>(node, field));
    case FieldDescriptor::CPPTYPE_UINT64:
      return put(&R::SetUInt64, &R::AddUInt64, parse_integer<std::uint64_t>(node, field));
    case FieldDescriptor::CPPTYPE_INT32:
      return put(&R::SetInt32, &R::AddInt32, parse_integer<std::int32_t>(node, field));
    case FieldDescriptor::CPPTYPE_INT64:
      return put(&R::SetInt64, &R::AddInt64, parse_integer<std::int64_t>(node, field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return put(&R::SetBool, &R::AddBool, parse_bool(node, field));
    case FieldDescriptor::CPPTYPE_ENUM:
      return put(&R::SetEnumValue, &R::AddEnumValue, parse_word(node, field));
    case FieldDescriptor::CPPTYPE_STRING:
      return put(&R::SetString, &R::AddString, parse_text(node));
    default:
      assertion_failed("known type", __FILE__, __LINE__, field.full_name() + " has a type that no scene can hold");
  }
}

void set_alternative(const Tree& node, Message& section) {
  const auto number = units::split_number(node.scalar);
  const auto members = alternatives(*section.GetDescriptor());
  std::string last_error;
  std::vector<std::string> words;
  for (const auto* member : members) {
    const bool word = member->cpp_type() == FieldDescriptor::CPPTYPE_ENUM;
    if (word) words = word_names(*member->enum_type());
    const bool with_unit = number && !number->unit.empty();
    const bool fits = word ? !number : number && with_unit == !key_of(*member).unit().empty();
    if (!fits) continue;
    try {
      return set_scalar(node, section, *member);
    } catch (const InputError& error) {
      last_error = error.what();
    }
  }
  if (number && !last_error.empty()) throw InputError(last_error);
  throw InputError(node.description() + " is not " + expected_section(*section.GetDescriptor()) +
                   hint(node.scalar, words));
}

}  // namespace grainstep::declare
