/// @file Laws are small scalar functions; the kernel applies them to eight elements at a time. That works only when
/// they are inlined into its lane loops, and into each instruction set's copy of them.
#pragma once

#define GS_ALWAYS_INLINE [[gnu::always_inline]] inline
