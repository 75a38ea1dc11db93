#pragma once

#include <kte/errors.hpp>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace kte::detail {

/// The numbers of one row, gathered from numbers and vectors of numbers. All scalars are converted to double, so that
/// all formats have equal values. Allocates once.
class table_row {
 public:
  /// `where`: the end of error messages.
  table_row(std::size_t columns, std::string where) : numbers_(columns), where_(std::move(where)) {}

  /// Throws `bad_argument` unless there is one number per column.
  template <class... T>
  std::span<const double> gather(const T&... values) {
    const std::size_t n = (std::size_t{0} + ... + count(values));
    if (n != numbers_.size()) [[unlikely]]
      raise<bad_argument>("kte: a row of " + std::to_string(n) + " numbers in a table of " +
                          std::to_string(numbers_.size()) + " columns" + where_);
    double* out = numbers_.data();
    (put(out, values), ...);
    return numbers_;
  }

 private:
  template <class T>
  static std::size_t count(const T& x) {
    if constexpr (requires { x.size(); }) {
      return static_cast<std::size_t>(x.size());
    } else {
      return 1;
    }
  }
  template <class T>
  static void put(double*& out, const T& x) {
    if constexpr (requires { x.size(); }) {
      for (decltype(x.size()) i = 0; i < x.size(); ++i) put(out, x[i]);
    } else {
      *out++ = static_cast<double>(x);
    }
  }

  std::vector<double> numbers_;
  std::string where_;
};

}  // namespace kte::detail
