/// @file Whether the system gives a process what it cannot do without. Libraries that are refused a descriptor, a
/// thread or memory in the middle of their work abort, crash or wait for ever: it is asked for before they are called.
#pragma once

namespace grainstep::base {

/// InputError that says which limit is too low, and how to raise it. Takes a tenth of a millisecond and keeps nothing.
void require_room();

}  // namespace grainstep::base
