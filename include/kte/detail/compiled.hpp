#pragma once

/// Runtime chains in double, compiled once: with KTE_COMPILED, which the CMake target kte::compiled defines for who
/// links it, the headers declare these instantiations `extern`, at their ends. The library is the unit that includes
/// kte/compiled.hpp, where KTE_EXTERN is nothing (docs/decisions/12-compiled.md).
#if defined(KTE_COMPILED) && !defined(KTE_EXTERN)
#  define KTE_EXTERN extern
#endif
