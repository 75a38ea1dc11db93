#pragma once

#include <kte/detail/macros_aside.hpp>

/// Compiles the runtime chains that are `extern` with KTE_COMPILED (kte/detail/compiled.hpp). Include it in one source
/// file, first, unless the program links the CMake target kte::compiled.
#if defined(KTE_EXTERN) || defined(KTE_FUNCTION)
#  error "kte: include kte/compiled.hpp before other headers of kte"
#endif
#include <kte/detail/compiled_here.hpp>
// clang-format off
#include <kte/compiled/chains.hpp>
#include <kte/compiled/loops.hpp>
#include <kte/compiled/contacts.hpp>
#include <kte/compiled/models.hpp>
#include <kte/compiled/elements.hpp>
#include <kte/compiled/registry.hpp>
#include <kte/compiled/analysis.hpp>
#include <kte/compiled/robots.hpp>

#include <kte/detail/macros_back.hpp>
