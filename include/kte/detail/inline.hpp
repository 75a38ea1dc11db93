#pragma once

/// Marks small geometric functions and element kernels, which must be inlined: only then do frames stay in registers,
/// and unread quantities disappear (docs/decisions/01-composition.md). With KTE_NO_FORCED_INLINE the compiler decides:
/// slow code, but fast compilation with sanitizers.
///
/// Such functions call only such functions and builtins where dual numbers and packs compute with them. A call of any
/// other small function, also of std, is inlined late by g++, in a time that is quadratic in the number of such calls
/// (bench/compile/inliner.sh).
#if (defined(__GNUC__) || defined(__clang__)) && !defined(KTE_NO_FORCED_INLINE)
#  define KTE_INLINE [[gnu::always_inline]] inline
#  define KTE_INLINE_LAMBDA __attribute__((always_inline))  // after the parameters of a lambda
#else
#  define KTE_INLINE inline
#  define KTE_INLINE_LAMBDA
#endif
