/// @file To be included before LAMMPS's C++ headers, which were written for an older fmt than Debian's: declares the
/// one name that they miss. The templates that use it are never instantiated here.
#pragma once

#include <fmt/format.h>

namespace fmt {
template <typename... Args, typename Text>
format_args make_args_checked(const Text& text, const Args&... values);
}
