#include "ledger/message_numbers.hpp"

#include <cmath>
#include <vector>

namespace grainstep::ledger {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::optional<std::string> check(const std::string& path, double value) {
  if (std::isfinite(value)) {
    return std::nullopt;
  }
  return path + " = " + std::to_string(value);
}

std::optional<std::string> check_doubles(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  if (!field.is_repeated()) {
    return check(field.name(), reflection.GetDouble(message, &field));
  }
  for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
    const double value = reflection.GetRepeatedDouble(message, &field, i);
    if (!std::isfinite(value)) {
      return check(field.name() + "[" + std::to_string(i) + "]", value);
    }
  }
  return std::nullopt;
}

std::optional<std::string> check_messages(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  if (!field.is_repeated()) {
    auto found = first_not_finite(reflection.GetMessage(message, &field));
    return found ? std::optional(field.name() + "." + *found) : std::nullopt;
  }
  for (int i = 0; i < reflection.FieldSize(message, &field); ++i) {
    if (auto found = first_not_finite(reflection.GetRepeatedMessage(message, &field, i))) {
      return field.name() + "[" + std::to_string(i) + "]." + *found;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> first_not_finite(const Message& message) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    std::optional<std::string> found;
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
      found = check_doubles(message, *field);
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      found = check_messages(message, *field);
    }
    if (found) {
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace grainstep::ledger
