#pragma once

#include <cmath>
#include <limits>

#include "contest.hpp"
#include "data/problems/error.hpp"

/// Right-hand sides by pointers to functions, so that problems with as many numbers share their integrators, which take
/// long to compile.
namespace work_precision {

template <int N>
using vector = Eigen::Matrix<double, N, 1>;

template <int N>
struct equations {
  vector<N> (*rate)(const double& t, const vector<N>& x);

  vector<N> operator()(const double& t, const vector<N>& x) const { return rate(t, x); }
};
template <int N>
struct equations_with_jacobian : equations<N> {
  void (*derivative)(const double& t, const vector<N>& x, Eigen::Matrix<double, N, N>& J);

  void jacobian(const double& t, const vector<N>& x, Eigen::Matrix<double, N, N>& J) const { derivative(t, x, J); }
};
/// x = (q, v), v' = a(t, q).
template <int N>
struct equations_of_second_order : equations<N> {
  static constexpr bool accelerations_ignore_velocities = true;
};

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// max |x_i - r_i| over the `count` numbers from the one at `from` on.
template <class X, std::size_t N>
double largest_error(const X& x, const long double (&r)[N], std::size_t from = 0, std::size_t count = N) {
  long double most = 0;
  for (std::size_t i = from; i < from + count; ++i) {
    const long double e = std::fabs(static_cast<long double>(x[static_cast<Eigen::Index>(i)]) - r[i]);
    if (!(e <= most)) most = std::isnan(e) ? std::numeric_limits<long double>::infinity() : e;
  }
  return static_cast<double>(most);
}
/// max |x_i - r_i| / |r_i|
template <class X, std::size_t N>
double largest_relative_error(const X& x, const long double (&r)[N]) {
  return std::pow(10, -kte::problems::scd(x, r));
}

template <class Problem>
vector<Problem::size> rate_of(const double& t, const vector<Problem::size>& x) {
  return Problem()(t, x);
}
template <class Problem>
void jacobian_of(const double& t, const vector<Problem::size>& x,
                 Eigen::Matrix<double, Problem::size, Problem::size>& J) {
  Problem().jacobian(t, x, J);
}
/// At the end; by the largest error of any component.
template <class Problem>
task<vector<Problem::size>> task_of() {
  using X = vector<Problem::size>;
  return {Problem::start(), static_cast<double>(Problem::t_end), [](const X& x) {
            judgement j{largest_error(x, Problem::reference), none, none, none};
            if constexpr (requires(const Problem& p) { p.energy(x); })
              j.energy = std::abs(Problem().energy(x) - Problem().energy(Problem::start()));
            return j;
          }};
}

}  // namespace work_precision
