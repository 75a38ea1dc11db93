// mistakes: 2
// expect: error: .*kte needs C\+\+20: compile with -std=c\+\+20
// All headers that users include begin with this one.
#include <kte/detail/macros_aside.hpp>
