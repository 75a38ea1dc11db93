// expect: error: .*kte: the number of rates of a law differs from the number of its states
#include <kte/models/controlled.hpp>

#include <array>

void rates(const std::array<double, 2>& c_dot) { kte::detail::check_law_rates<1>(c_dot); }
