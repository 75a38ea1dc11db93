#pragma once

namespace work_precision {

/// Prints, of methods with a fixed step of 0.02 s on a pendulum, in each tenth of `steps` steps: method, tenth, the
/// largest energy gained or lost in it, J.
void print_long_time(long long steps);

/// Prints, for integrations of the iiwa14: method, CPU time of an integration, its evaluations, CPU time of an
/// evaluation, and how many percent more than its evaluations the integration takes. Medians of `rounds` rounds.
void print_overhead(int rounds);

}  // namespace work_precision
