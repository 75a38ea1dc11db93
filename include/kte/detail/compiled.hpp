#pragma once

/// Runtime chains in double, compiled once. With KTE_COMPILED, which the CMake target kte::compiled defines for its
/// users, headers declare these instantiations `extern` at their ends, and omit the bodies of their larger functions.
/// The library is the unit that includes kte/compiled.hpp (docs/decisions/12-compiled.md).
///
///                  headers only    users of the library    the library
///   KTE_EXTERN      not defined     extern                   nothing
///   KTE_FUNCTION    inline          not defined              nothing
///
/// The library may also be several units (kte/detail/compiled_here.hpp).
#if defined(KTE_COMPILED)
#  define KTE_EXTERN extern
#else
#  define KTE_FUNCTION inline
#endif
