#include "mutate_fields.hpp"

#include <google/protobuf/struct.pb.h>

#include <vector>

#include "extremes.hpp"

namespace grainstep::fuzz {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;
using Random = std::mt19937_64;

constexpr int most_numbers = 300;
constexpr int most_messages = 32;
constexpr int most_depth = 12;

/// A field of a message that is there.
struct Place {
  Message* in;
  const FieldDescriptor* field;
};

void collect(Message& message, std::vector<Place>& places, int depth) {
  if (depth > most_depth) return;
  const Reflection& reflection = *message.GetReflection();
  const auto& type = *message.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor* field = type.field(i);
    if (field->is_map()) continue;  // free settings, which no code of ours reads by itself
    places.push_back({&message, field});
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    if (!field->is_repeated()) {
      if (reflection.HasField(message, field)) collect(*reflection.MutableMessage(&message, field), places, depth + 1);
      continue;
    }
    for (int k = 0; k < reflection.FieldSize(message, field); ++k) {
      collect(*reflection.MutableRepeatedMessage(&message, field, k), places, depth + 1);
    }
  }
}

void set_value(Message& message, const FieldDescriptor* field, Random& random) {
  const Reflection& reflection = *message.GetReflection();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.SetDouble(&message, field, extreme_double(reflection.GetDouble(message, field), random));
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.SetUInt32(&message, field, extreme_integer(reflection.GetUInt32(message, field), random));
    case FieldDescriptor::CPPTYPE_UINT64:
      return reflection.SetUInt64(&message, field, extreme_integer(reflection.GetUInt64(message, field), random));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.SetBool(&message, field, !reflection.GetBool(message, field));
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.SetEnumValue(&message, field, static_cast<int>(random() % 9) - 1);
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection.SetString(&message, field, extreme_text(reflection.GetString(message, field), random));
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return static_cast<void>(reflection.MutableMessage(&message, field));
    default:
      return;  // the protocol has no others
  }
}

void set_item(Message& message, const FieldDescriptor* field, int at, Random& random) {
  const Reflection& reflection = *message.GetReflection();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.SetRepeatedDouble(&message, field, at,
                                          extreme_double(reflection.GetRepeatedDouble(message, field, at), random));
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.SetRepeatedUInt32(&message, field, at,
                                          extreme_integer(reflection.GetRepeatedUInt32(message, field, at), random));
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection.SetRepeatedString(&message, field, at,
                                          extreme_text(reflection.GetRepeatedString(message, field, at), random));
    default:
      return;
  }
}

void add_item(Message& message, const FieldDescriptor* field, Random& random) {
  const Reflection& reflection = *message.GetReflection();
  const int size = reflection.FieldSize(message, field);
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.AddDouble(&message, field, extreme_double(0.0, random));
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.AddUInt32(&message, field, static_cast<std::uint32_t>(random() % 8));
    case FieldDescriptor::CPPTYPE_STRING:
      return reflection.AddString(&message, field, extreme_text("", random));
    case FieldDescriptor::CPPTYPE_MESSAGE: {
      Message& added = *reflection.AddMessage(&message, field);
      if (size > 0) added.CopyFrom(reflection.GetRepeatedMessage(message, field, static_cast<int>(random() % size)));
      return;
    }
    default:
      return;
  }
}

/// Grows, shrinks, or has two of its items exchanged.
void change_list(Message& message, const FieldDescriptor* field, Random& random) {
  const Reflection& reflection = *message.GetReflection();
  const int size = reflection.FieldSize(message, field);
  const std::uint64_t kind = random() % 16;
  if (size == 0 || kind < 3) return add_item(message, field, random);
  if (kind < 6) return reflection.RemoveLast(&message, field);
  if (kind < 7) return reflection.ClearField(&message, field);
  if (kind < 8) {
    const bool numbers = field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE;
    for (int left = (numbers ? most_numbers : most_messages) - size; left > 0; --left) add_item(message, field, random);
    return;
  }
  if (kind < 10) {
    return reflection.SwapElements(&message, field, static_cast<int>(random() % size),
                                   static_cast<int>(random() % size));
  }
  set_item(message, field, static_cast<int>(random() % size), random);
}

void change(const Place& place, Random& random) {
  if (place.field->is_repeated()) return change_list(*place.in, place.field, random);
  if (random() % 8 == 0) return place.in->GetReflection()->ClearField(place.in, place.field);
  set_value(*place.in, place.field, random);
}

}  // namespace

void change_field(Message& message, Random& random) {
  std::vector<Place> places;
  collect(message, places, 0);
  // A change at the top is another kind of message, which is seldom of interest: the order is changed elsewhere.
  const auto top = static_cast<std::uint64_t>(message.GetDescriptor()->field_count());
  const bool inside = places.size() > top && random() % 32 != 0;
  std::uint64_t at = random() % places.size();
  while (inside && places[at].in == &message) at = random() % places.size();
  change(places[at], random);
}

}  // namespace grainstep::fuzz
