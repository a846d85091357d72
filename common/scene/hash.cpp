#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <xxhash.h>

#include <memory>
#include <string>

#include "declare/declaration.hpp"
#include "declare/read.hpp"
#include "scene/load.hpp"

namespace grainstep::scene {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::string serialised(const Message& message) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    message.SerializeToCodedStream(&coded);
  }
  return bytes;
}

std::uint64_t hash_of(const Message& message) {
  const std::string bytes = serialised(message);
  return XXH3_64bits(bytes.data(), bytes.size());
}

/// Whether `field` alone says the same in both.
bool same(const Message& one, const Message& other, const FieldDescriptor& field) {
  const auto only = [&field](const Message& from) {
    std::unique_ptr<Message> part(from.New());
    part->CopyFrom(from);
    std::vector<const FieldDescriptor*> set;
    part->GetReflection()->ListFields(*part, &set);
    for (const FieldDescriptor* present : set) {
      if (present != &field) part->GetReflection()->ClearField(part.get(), present);
    }
    return serialised(*part);
  };
  return only(one) == only(other);
}

/// Adds to `zeros` what Protobuf does not write although it is not the default: numbers that are 0 where the default is
/// another one.
void drop_defaults(Message& message, const std::string& path, std::string& zeros) {
  const auto& reflection = *message.GetReflection();
  const std::unique_ptr<Message> defaults = declare::defaults_of(message);
  std::vector<const FieldDescriptor*> set;
  reflection.ListFields(*defaults, &set);
  for (const FieldDescriptor* field : set) {
    const bool is_number = !field->has_presence() && !field->is_repeated();
    if (is_number && !reflection.HasField(message, field)) zeros += path + field->name() + ";";
  }
  set.clear();
  reflection.ListFields(message, &set);
  for (const FieldDescriptor* field : set) {
    if (!declare::is_section(*field)) {
      if (same(message, *defaults, *field)) reflection.ClearField(&message, field);
    } else if (field->is_repeated()) {
      for (int i = 0; i < reflection.FieldSize(message, field); ++i) {
        drop_defaults(*reflection.MutableRepeatedMessage(&message, field, i),
                      path + field->name() + "." + std::to_string(i) + ".", zeros);
      }
    } else {
      Message& part = *reflection.MutableMessage(&message, field);
      drop_defaults(part, path + field->name() + ".", zeros);
      if (part.ByteSizeLong() == 0 && declare::key_of(*field).default_value() == "{}")
        reflection.ClearField(&message, field);
    }
  }
}

}  // namespace

std::uint64_t scene_hash(const Scene& scene) { return hash_of(scene); }

std::uint64_t essence_hash(const Scene& scene) {
  Scene essence = scene;
  essence.clear_title();
  std::string zeros;
  drop_defaults(essence, "", zeros);
  const std::string bytes = serialised(essence) + zeros;
  return XXH3_64bits(bytes.data(), bytes.size());
}

}  // namespace grainstep::scene
