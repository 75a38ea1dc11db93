// The order counts: kte/detail/compiled_here.hpp.
// clang-format off
#include <kte/compiled/loops.hpp>
#include <kte/detail/compiled_here.hpp>
#include <kte/compiled/contacts.hpp>
