// expect: error: .*kte: the rates of a law have another number of entries than the law has states
#include <kte/models/controlled.hpp>

#include <array>

void rates(const std::array<double, 2>& c_dot) { kte::detail::check_law_rates<1>(c_dot); }
