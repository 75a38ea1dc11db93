#include <kte/sweep/sweep_cases.hpp>

#include <cmath>
#include <set>

#include "catch.hpp"

namespace cases_test {

using kte::test::says;

TEST_CASE("a grid: the last column changes fastest") {
  const auto grid = kte::one_of("a", {1, 2}) * kte::evenly("b", 0, 1, 3);
  CHECK(grid.names() == std::vector<std::string>{"a", "b"});
  REQUIRE(grid.count() == 6);
  const double a[]{1, 1, 1, 2, 2, 2}, b[]{0, 0.5, 1, 0, 0.5, 1};
  for (std::size_t i = 0; i < 6; ++i) CHECK((grid(i, 0) == a[i] && grid(i, 1) == b[i]));
  CHECK(kte::evenly("x", 3, 4, 1)(0, 0) == 3);
  CHECK(kte::evenly("x", 0, 0.3, 4)(3, 0) == 0.3);  // exactly the last
  const auto many = kte::evenly("x", 0, 1, std::uint64_t{1} << 33);
  CHECK_THROWS_MATCHES(many * many, kte::bad_argument, says("2^64"));
}

TEST_CASE("a list of cases") {
  const auto list = kte::list_of_cases({"a", "b"}, {{1, 2}, {3, 4}, {5, 6}});
  CHECK(list.count() == 3);
  CHECK(list(2, 1) == 6);
  CHECK_THROWS_MATCHES(kte::list_of_cases({"a", "b"}, {{1, 2}, {3}}), kte::bad_argument,
                       says("case 1 of a list has 1 values for 2 columns"));
}

TEST_CASE("random cases: a function of seed, case and column, with the distribution") {
  const auto columns = std::vector{kte::uniform("u", -1, 3), kte::normal("n", 5, 2), kte::log_uniform("l", 0.1, 10)};
  const std::uint64_t n = 20000;
  const auto x = kte::random_cases(n, 42, columns), more = kte::random_cases(2 * n, 42, columns),
             other = kte::random_cases(n, 43, columns);
  double mean = 0, square = 0, decades = 0, together = 0;
  std::set<double> distinct;
  for (std::uint64_t i = 0; i < n; ++i) {
    const double u = x(i, 0), v = x(i, 1), l = x(i, 2);
    CHECK((u > -1 && u < 3 && l > 0.1 && l < 10));
    mean += u, square += (v - 5) * (v - 5), decades += std::log10(l), together += (u - 1) * (v - 5);
    distinct.insert(u);
  }
  const double N = static_cast<double>(n);
  CHECK(mean / N == within(1, 0.03));      // deviation 1.15 / sqrt(n) = 0.008
  CHECK(square / N == within(4, 0.15));    // deviation 4 sqrt(2 / n) = 0.04
  CHECK(decades / N == within(0, 0.015));  // deviation 0.58 / sqrt(n) = 0.004
  CHECK(together / N == within(0, 0.07));  // deviation 2.3 / sqrt(n) = 0.016
  CHECK(distinct.size() == n);
  CHECK(more(77, 1) == x(77, 1));
  CHECK(other(77, 1) != x(77, 1));
}

TEST_CASE("the inverse of the normal distribution") {
  // From tables with 17 digits.
  CHECK(kte::detail::inverse_normal(0.975) == within(1.9599639845400545, 1e-15));
  CHECK(kte::detail::inverse_normal(1e-10) == within(-6.361340902404056, 1e-14));
  CHECK(kte::detail::inverse_normal(1e-300) == within(-37.0471, 1e-4));
  for (const double p : {1e-20, 0.001, 0.02, 0.3, 0.5, 0.7, 0.999})
    CHECK(std::erfc(-kte::detail::inverse_normal(p) / std::sqrt(2.0)) / 2 == within_relative(p, 1e-13));
  CHECK_THROWS_MATCHES(kte::normal("x", 0, -1), kte::bad_argument, says("the distribution of 'x'"));
  CHECK_THROWS_MATCHES(kte::log_uniform("x", 0, 1), kte::bad_argument, says("positive"));
  CHECK_THROWS_MATCHES(kte::uniform("x", 2, 1), kte::bad_argument, says("in order"));
}

TEST_CASE("Sobol points") {
  // The first points in three dimensions, in Gray code order.
  const double expected[][3]{{0, 0, 0},
                             {0.5, 0.5, 0.5},
                             {0.75, 0.25, 0.25},
                             {0.25, 0.75, 0.75},
                             {0.375, 0.375, 0.625},
                             {0.875, 0.875, 0.125},
                             {0.625, 0.125, 0.875},
                             {0.125, 0.625, 0.375}};
  std::vector<kte::distributed> columns;
  for (std::size_t j = 0; j < 21; ++j) columns.push_back(kte::uniform("x" + std::to_string(j), 0, 1));
  const auto x = kte::sobol_cases(1024, columns);
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = 0; j < 3; ++j) CHECK(x(i, j) == expected[i][j] + 0x1p-33);
  // 2^k points have one in each of 2^k equal parts of every axis.
  for (std::size_t j = 0; j < 21; ++j) {
    std::set<int> parts;
    for (std::uint64_t i = 0; i < 1024; ++i) parts.insert(static_cast<int>(x(i, j) * 1024));
    CHECK(parts.size() == 1024);
  }
  // x0 + 2 x20 has the mean 1.5: random points would miss it by 0.02.
  double mean = 0;
  for (std::uint64_t i = 0; i < 1024; ++i) mean += (x(i, 0) + 2 * x(i, 20)) / 1024;
  CHECK(mean == within(1.5, 0.002));
  columns.push_back(kte::uniform("more", 0, 1));
  CHECK_THROWS_MATCHES(kte::sobol_cases(8, columns), kte::bad_argument, says("at most 21 columns"));
}

}  // namespace cases_test
