// clang-format off: the order counts (kte/detail/compiled_here.hpp)
#include <kte/compiled/first_elements.hpp>
#include <kte/detail/compiled_here.hpp>
#include <kte/compiled/elements.hpp>
