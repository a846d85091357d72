#include "declare/ranges.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "declare/declaration.hpp"

namespace grainstep::declare {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

bool in_range(const options::Key& key, double value) {
  return std::isfinite(value) && !(key.has_above() && !(value > key.above())) &&
         !(key.has_min() && !(value >= key.min())) && !(key.has_below() && !(value < key.below())) &&
         !(key.has_max() && !(value <= key.max()));
}

void require_in_range(const FieldDescriptor& field, const std::string& path, double value) {
  const options::Key& key = key_of(field);
  if (in_range(key, value)) return;
  const std::string range = range_text(key);
  throw InputError(path + ": found " + rounded_text(value) + ", expected a number" + (range.empty() ? "" : " ") +
                   range + (key.unit().empty() ? "" : ", in " + key.unit()) +
                   ". The orchestrator sends a scene with every default filled in.");
}

double number_of(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.GetDouble(message, &field);
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.GetUInt32(message, &field);
    default:
      return static_cast<double>(reflection.GetUInt64(message, &field));
  }
}

bool is_number(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE || field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32 ||
         field.cpp_type() == FieldDescriptor::CPPTYPE_UINT64;
}

/// Lists of numbers in scenes are of doubles.
void require_list(const Message& message, const FieldDescriptor& field, const std::string& path) {
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
    const std::string item = path + "." + std::to_string(i);
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      require_ranges(reflection.GetRepeatedMessage(message, &field, i), item);
    } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
      require_in_range(field, item, reflection.GetRepeatedDouble(message, &field, i));
    }
  }
}

}  // namespace

void require_ranges(const Message& message, const std::string& path) {
  const auto& type = *message.GetDescriptor();
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    const std::string inner = path + "." + field.name();
    if (field.is_repeated()) {
      require_list(message, field, inner);
    } else if (field.has_presence() && !reflection.HasField(message, &field)) {
      continue;
    } else if (is_number(field)) {
      require_in_range(field, inner, number_of(message, field));
    } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !is_free(field)) {
      require_ranges(reflection.GetMessage(message, &field), inner);
    }
  }
}

}  // namespace grainstep::declare
