/// @file One scalar of a scene to one value of a message.
#pragma once

#include <google/protobuf/message.h>

#include "declare/tree.hpp"

namespace grainstep::declare {

/// Reads `node` as a value of `field`, checks its range, and sets it (adds it, where `field` is repeated).
/// `node` is a scalar, `field` no message.
/// @throws InputError: what was found, what was expected; without the place, which the caller knows.
void set_scalar(const Tree& node, google::protobuf::Message& message, const google::protobuf::FieldDescriptor& field);

/// Reads `node` as the member of a scalar_form section that fits it.
/// @throws InputError as above.
void set_alternative(const Tree& node, google::protobuf::Message& section);

}  // namespace grainstep::declare
