#include "declare/free_settings.hpp"

#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "declare/quoted.hpp"

namespace grainstep::declare {
namespace {

using google::protobuf::Struct;
using google::protobuf::Value;

Value value_of_scalar(const Tree& tree) {
  Value out;
  const std::string& text = tree.scalar;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = !text.empty() && end == text.data() + text.size();
  if (is_number && error == std::errc::result_out_of_range) throw InputError(tree.description() + " is out of range");
  if (!tree.quoted && (text == "true" || text == "false")) {
    out.set_bool_value(text == "true");
  } else if (!tree.quoted && is_number && error == std::errc() && std::isfinite(number)) {
    out.set_number_value(number);
  } else {
    out.set_string_value(text);
  }
  return out;
}

Value value_of(const Tree& tree) {
  Value out;
  switch (tree.kind) {
    case Tree::Kind::null:
      out.set_null_value(google::protobuf::NULL_VALUE);
      break;
    case Tree::Kind::scalar:
      return value_of_scalar(tree);
    case Tree::Kind::list:
      out.mutable_list_value();
      for (const Tree& item : tree.items) *out.mutable_list_value()->add_values() = value_of(item);
      break;
    case Tree::Kind::map:
      *out.mutable_struct_value() = free_settings(tree);
      break;
  }
  return out;
}

std::string text_of(const Value& value) {
  switch (value.kind_case()) {
    case Value::kBoolValue:
      return value.bool_value() ? "true" : "false";
    case Value::kNumberValue:
      return number_text(value.number_value());
    case Value::kStringValue:
      return quoted(value.string_value());
    case Value::kStructValue:
      return to_yaml(value.struct_value());
    case Value::kListValue: {
      std::string items;
      for (const Value& item : value.list_value().values()) items += (items.empty() ? "" : ", ") + text_of(item);
      return "[" + items + "]";
    }
    default:
      return "null";
  }
}

}  // namespace

Struct free_settings(const Tree& tree) {
  Struct out;
  for (const auto& [name, member] : tree.members) (*out.mutable_fields())[name] = value_of(member);
  return out;
}

std::string to_yaml(const Struct& settings) {
  const std::map<std::string, Value> ordered(settings.fields().begin(), settings.fields().end());
  std::string members;
  for (const auto& [name, value] : ordered)
    members += (members.empty() ? "" : ", ") + quoted(name) + ": " + text_of(value);
  return "{" + members + "}";
}

}  // namespace grainstep::declare
