#pragma once

/// KTE_HAS_SHUFFLES: the compiler has __builtin_shufflevector.
#if defined(__has_builtin)
#  if __has_builtin(__builtin_shufflevector)
#    define KTE_HAS_SHUFFLES 1
#  endif
#endif
