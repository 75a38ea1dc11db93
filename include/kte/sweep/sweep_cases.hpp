#pragma once

#include <kte/errors.hpp>
#include <kte/sweep/detail/sobol_point.hpp>
#include <kte/sweep/distributions.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace kte {

/// What a sweep varies: a number of cases, and a value for each column in each case. A value is a function of the
/// number of the case only, so that cases can be computed in any order, and need no memory.
///
///   kte::one_of("length", {0.5, 1.0}) * kte::evenly("mass", 1, 2, 101)      // a grid of 202 cases
///   kte::random_cases(1'000'000, seed, {kte::uniform("mass", 1, 2), kte::normal("push", 0, 0.1)})
class sweep_cases {
 public:
  /// value(i, j): column j of case i.
  using value_function = std::function<double(std::uint64_t, std::size_t)>;

  sweep_cases(std::vector<std::string> names, std::uint64_t count, value_function value)
      : names_(std::move(names)), count_(count), value_(std::move(value)) {}

  /// The names of the columns.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// The number of cases.
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Column j of case i.
  [[nodiscard]] double operator()(std::uint64_t i, std::size_t j) const { return value_(i, j); }

  /// Every case of a with every case of b; those of b change faster.
  [[nodiscard]] friend sweep_cases operator*(const sweep_cases& a, const sweep_cases& b) {
    if (b.count_ != 0 && a.count_ > (std::numeric_limits<std::uint64_t>::max)() / b.count_)
      detail::raise<bad_argument>("kte: a sweep of more than 2^64 cases");
    auto names = a.names_;
    names.insert(names.end(), b.names_.begin(), b.names_.end());
    return {std::move(names), a.count_ * b.count_, [a, b](std::uint64_t i, std::size_t j) {
              return j < a.names_.size() ? a(i / b.count_, j) : b(i % b.count_, j - a.names_.size());
            }};
  }

 private:
  std::vector<std::string> names_;
  std::uint64_t count_;
  value_function value_;
};

/// One column with these values.
[[nodiscard]] inline sweep_cases one_of(std::string name, std::vector<double> numbers) {
  const std::uint64_t n = numbers.size();
  return {{std::move(name)}, n, [x = std::move(numbers)](std::uint64_t i, std::size_t) { return x[i]; }};
}
/// One column with n values from `first` to `last`, evenly spaced: first + i (last - first) / (n - 1).
[[nodiscard]] inline sweep_cases evenly(std::string name, double first, double last, std::uint64_t n) {
  return {{std::move(name)}, n, [=](std::uint64_t i, std::size_t) {
            return i == 0       ? first
                   : i + 1 == n ? last
                                : first + static_cast<double>(i) * ((last - first) / static_cast<double>(n - 1));
          }};
}
/// Cases given as a list, each with one value per column. Throws `bad_argument` for one of another size.
[[nodiscard]] inline sweep_cases list_of_cases(std::vector<std::string> names, std::vector<std::vector<double>> cases) {
  for (const auto& c : cases)
    if (c.size() != names.size())
      detail::raise<bad_argument>("kte: case " + std::to_string(&c - cases.data()) + " of a list has " +
                                  std::to_string(c.size()) + " values for " + std::to_string(names.size()) +
                                  " columns");
  const std::uint64_t n = cases.size();
  return {std::move(names), n, [x = std::move(cases)](std::uint64_t i, std::size_t j) { return x[i][j]; }};
}

namespace detail {
inline std::vector<std::string> names_of(const std::vector<distributed>& columns) {
  std::vector<std::string> names;
  for (const auto& c : columns) names.push_back(c.name());
  return names;
}
}  // namespace detail

/// n cases of independent random numbers with these distributions. Case i depends on the seed and i only: a sweep with
/// more cases begins with the same ones.
[[nodiscard]] inline sweep_cases random_cases(std::uint64_t n, std::uint64_t seed, std::vector<distributed> columns) {
  auto names = detail::names_of(columns);
  return {std::move(names), n, [=, x = std::move(columns)](std::uint64_t i, std::size_t j) {
            return x[j](detail::uniform_number(seed, i, j));
          }};
}
/// n points of Sobol's sequence, which fill the ranges of the columns more evenly than random numbers; best for n a
/// power of two. Each coordinate is moved by half of 2^-32, so that no distribution is evaluated at 0. Throws
/// `bad_argument` for more than 21 columns or 2^32 cases.
[[nodiscard]] inline sweep_cases sobol_cases(std::uint64_t n, std::vector<distributed> columns) {
  if (columns.size() > detail::sobol_dimensions)
    detail::raise<bad_argument>("kte: Sobol points have at most " + std::to_string(detail::sobol_dimensions) +
                                " columns, got " + std::to_string(columns.size()));
  if (n > std::uint64_t{1} << 32) detail::raise<bad_argument>("kte: there are 2^32 Sobol points, not more");
  std::vector<std::array<std::uint32_t, 32>> directions;
  for (std::size_t j = 0; j < columns.size(); ++j) directions.push_back(detail::sobol_directions(j));
  auto names = detail::names_of(columns);
  return {std::move(names), n, [x = std::move(columns), d = std::move(directions)](std::uint64_t i, std::size_t j) {
            return x[j](detail::sobol_coordinate(i, d[j]) + 0x1p-33);
          }};
}

}  // namespace kte
