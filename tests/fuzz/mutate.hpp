/// @file Changes scripts as somebody would who knows what the messages mean: fields get extreme values, lists grow and
/// shrink, messages are dropped, repeated and put in another order, and bytes are damaged.
#pragma once

#include <random>

#include "script.pb.h"

namespace grainstep::fuzz {

using Random = std::mt19937_64;

/// One change, or some.
void mutate(Script& script, Random& random);

/// `script` goes on like `other` from some message on.
void cross(Script& script, const Script& other, Random& random);

}  // namespace grainstep::fuzz
