#pragma once

/// Marks the small geometric functions and the element kernels. They are worth nothing unless they are inlined: only
/// then do frames stay in registers and unread quantities vanish (docs/decisions/01-composition.md).
#if defined(__GNUC__) || defined(__clang__)
#  define KTE_INLINE [[gnu::always_inline]] inline
#else
#  define KTE_INLINE inline
#endif

/// The same for a lambda, behind its parameters.
#if defined(__GNUC__) || defined(__clang__)
#  define KTE_INLINE_LAMBDA __attribute__((always_inline))
#else
#  define KTE_INLINE_LAMBDA
#endif
