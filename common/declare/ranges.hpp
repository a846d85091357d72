/// @file The ranges of keys, as their declarations say them, in a message that no loader of ours has read: a
/// participant's part of a scene comes over the wire, from whoever is at its other end.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace grainstep::declare {

/// Throws InputError for the first number that is none or out of its key's range: which key, what was found, what was
/// expected. `path`: of `message` in a scene. What a message may leave out, and does, has no range.
void require_ranges(const google::protobuf::Message& message, const std::string& path);

}  // namespace grainstep::declare
