#pragma once

/// Runtime chains in double, compiled once: with KTE_COMPILED, which the CMake target kte::compiled defines for who
/// links it, the headers declare these instantiations `extern`, at their ends, and leave out the bodies of their larger
/// functions. The library is the unit that includes kte/compiled.hpp (docs/decisions/12-compiled.md).
///
///                   headers only    who links the library    the library
///   KTE_EXTERN      not defined     extern                   nothing
///   KTE_FUNCTION    inline          not defined              nothing
/// Its elements may be a unit of their own, to compile beside the rest: KTE_COMPILED_LOOPS in the unit that includes
/// kte/compiled.hpp, KTE_COMPILED_ELEMENTS in one that includes kte/elements/registry.hpp as a user.
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
