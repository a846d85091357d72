/// @file A change of one field of a message, somewhere in it, by Protobuf's reflection.
#pragma once

#include <google/protobuf/message.h>

#include <random>

namespace grainstep::fuzz {

void change_field(google::protobuf::Message& message, std::mt19937_64& random);

}  // namespace grainstep::fuzz
