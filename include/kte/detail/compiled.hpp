#pragma once

/// Runtime chains in double, compiled once: with KTE_COMPILED, which the CMake target kte::compiled defines for who
/// links it, the headers declare these instantiations `extern`, at their ends, and leave out the bodies of their larger
/// functions. The library is the unit that includes kte/compiled.hpp (docs/decisions/12-compiled.md).
///
///                   headers only    who links the library    the library
///   KTE_EXTERN      not defined     extern                   nothing
///   KTE_FUNCTION    inline          not defined              nothing
#if defined(KTE_COMPILED_HERE)
#  define KTE_EXTERN
#  define KTE_FUNCTION
#elif defined(KTE_COMPILED)
#  define KTE_EXTERN extern
#else
#  define KTE_FUNCTION inline
#endif
