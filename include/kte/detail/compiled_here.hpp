#pragma once

/// From here on, this unit compiles what headers declare `extern` with KTE_COMPILED (kte/detail/compiled.hpp). What the
/// headers before contain is compiled in other units: so each header of kte/compiled makes a unit of its own,
///
///   #include <kte/compiled/A.hpp>              all headers that are before it in kte/compiled.hpp
///   #include <kte/detail/compiled_here.hpp>
///   #include <kte/compiled/B.hpp>
///
/// which CMake writes. Every function is compiled in the first of them whose headers contain it, also by way of others.
#include <kte/detail/compiled.hpp>

#undef KTE_EXTERN
#undef KTE_FUNCTION
#define KTE_EXTERN
#define KTE_FUNCTION
#define KTE_COMPILED_HERE
