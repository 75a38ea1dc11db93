#pragma once

/// From here on, this unit compiles what headers declare `extern` with KTE_COMPILED (kte/detail/compiled.hpp).
/// Functions of headers that were included before are in other units. CMake so makes a unit of each part of
/// kte/compiled.hpp, as a user of the parts that it includes:
///
///   #include <kte/compiled/chains.hpp>
///   #include <kte/detail/compiled_here.hpp>
///   #include <kte/compiled/loops.hpp>
///
/// A function is compiled in the first part whose headers contain it, by whatever way they are included.
#include <kte/detail/compiled.hpp>

#undef KTE_EXTERN
#undef KTE_FUNCTION
#define KTE_EXTERN
#define KTE_FUNCTION
#define KTE_COMPILED_HERE
