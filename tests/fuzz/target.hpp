/// @file What a fuzz program is made of: a target says what becomes of a script; the rest is common.
#pragma once

#include "script.pb.h"
#include "statistics.hpp"

namespace grainstep::fuzz {

/// Defined by each target. Returns if all went as it should, whatever the script says; anything else that happens is a
/// finding: a failed assertion, an exception that escapes, a sanitizer's report.
void try_script(const Script& script);

}  // namespace grainstep::fuzz
