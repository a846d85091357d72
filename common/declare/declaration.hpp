/// @file The declaration of a message in proto/, as the loader and the generators read it (options.proto).
#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <vector>

#include "grainstep/options.pb.h"

namespace grainstep::declare {

[[nodiscard]] const options::Key& key_of(const google::protobuf::FieldDescriptor& field);
[[nodiscard]] const options::Section& section_of(const google::protobuf::Descriptor& message);

/// Settings that are not declared: any keys (free_settings.hpp).
[[nodiscard]] bool is_free(const google::protobuf::FieldDescriptor& field);
/// A map of declared keys.
[[nodiscard]] bool is_section(const google::protobuf::FieldDescriptor& field);

/// An enumerated word as it is written in a scene.
struct Word {
  std::string word;
  int number = 0;
  std::string text;
};

/// All words of an enumeration, without its ..._UNSET.
[[nodiscard]] std::vector<Word> words_of(const google::protobuf::EnumDescriptor& type);
[[nodiscard]] std::vector<std::string> word_names(const google::protobuf::EnumDescriptor& type);

/// The word for `number`; empty for ..._UNSET.
[[nodiscard]] std::string word_for(const google::protobuf::EnumDescriptor& type, int number);

[[nodiscard]] std::vector<std::string> key_names(const google::protobuf::Descriptor& message);

/// The members among which the value of a scalar_form section chooses.
[[nodiscard]] std::vector<const google::protobuf::FieldDescriptor*> alternatives(
    const google::protobuf::Descriptor& message);

/// What may be written for one value of `field`: "a number with a unit of m", "one of dh36, elastic", "a list of ...".
[[nodiscard]] std::string expected_value(const google::protobuf::FieldDescriptor& field);
[[nodiscard]] std::string expected_section(const google::protobuf::Descriptor& message);

/// "above 0, at most 1", or an empty string.
[[nodiscard]] std::string range_text(const options::Key& key);

/// "20 MPa to 5 GPa", "at most 2", or an empty string: where a value needs no second look.
[[nodiscard]] std::string usual_range(const options::Key& key);

/// " Usual: 20 MPa to 5 GPa." for documents, or an empty string.
[[nodiscard]] std::string usual_sentence(const options::Key& key);

}  // namespace grainstep::declare
