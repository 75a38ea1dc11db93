// clang-format off: the order counts (kte/detail/compiled_here.hpp)
#include <kte/compiled/loops.hpp>
#include <kte/detail/compiled_here.hpp>
#include <kte/compiled/control.hpp>
