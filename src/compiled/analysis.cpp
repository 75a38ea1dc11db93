// The order counts: kte/detail/compiled_here.hpp.
// clang-format off
#include <kte/compiled/models.hpp>
#include <kte/compiled/registry.hpp>
#include <kte/detail/compiled_here.hpp>
#include <kte/compiled/analysis.hpp>
