/// @file The instruction set of the machine that we run on, as a level of the x86-64 psABI.
#pragma once

namespace grainstep {

/// Higher ones include lower ones. Machines of another architecture have none of them.
enum class X86Level : int { none, v1, v2, v3, v4 };

[[nodiscard]] X86Level x86_level();

/// "x86-64-v3", or the name of another architecture.
[[nodiscard]] const char* instruction_set_name();

}  // namespace grainstep
