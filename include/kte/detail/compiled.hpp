#pragma once

/// Runtime chains in double, compiled once. With KTE_COMPILED, which the CMake target kte::compiled defines for its
/// users, headers declare these instantiations `extern` at their ends, and omit the bodies of their larger functions.
/// The library is the unit that includes kte/compiled.hpp (docs/decisions/12-compiled.md).
///
///                  headers only    users of the library    the library
///   KTE_EXTERN      not defined     extern                   nothing
///   KTE_FUNCTION    inline          not defined              nothing
/// Its elements may be a separate unit, compiled in parallel: KTE_COMPILED_LOOPS in the unit that includes
/// kte/compiled.hpp, KTE_COMPILED_ELEMENTS in one that includes kte/elements/registry.hpp.
#if defined(KTE_COMPILED_HERE)
#  define KTE_EXTERN
#  define KTE_FUNCTION
#  ifdef KTE_COMPILED_LOOPS
#    define KTE_EXTERN_ELEMENTS extern
#  else
#    define KTE_EXTERN_ELEMENTS
#  endif
#elif defined(KTE_COMPILED)
#  define KTE_EXTERN extern
#  ifdef KTE_COMPILED_ELEMENTS
#    define KTE_EXTERN_ELEMENTS
#  else
#    define KTE_EXTERN_ELEMENTS extern
#  endif
#else
#  define KTE_FUNCTION inline
#endif
