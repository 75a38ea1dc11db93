#pragma once

#include <Eigen/Core>

#include <type_traits>
#include <utility>

#include "straightline/tape.hpp"

namespace straightline {

/// A scalar that writes down what is done to it. Run kte's own formulas on it, and the tape holds them with all
/// structure of the robot resolved:
///
///   0+x -> x,  0*x -> 0,  1*x -> x,  x-x -> 0,  numbers with numbers -> a number          (1)
///   (-a)*b -> -(a*b),  a+(-b) -> a-b,  (-a)-b -> -(a+b)                                   (2)
///   a+b is b+a,  a*b is b*a,  b-a is -(a-b)                                               (3)
class traced {
 public:
  traced() : traced(0) {}
  template <class T>
  requires std::is_arithmetic_v<T> traced(T x)  // NOLINT(google-explicit-constructor)
      : negative_(x < 0),
        index_(current().find({op::number, 0, 0,
                               x < 0    ? -double(x)
                               : x == 0 ? 0.0
                                        : double(x)})) {}
  static traced input(std::size_t i) { return make({op::input, i, 0, 0}); }

  std::size_t index() const { return index_; }
  bool negative() const { return negative_; }
  bool constant() const { return current()[index_].by == op::number; }
  /// The value of a constant.
  double value() const { return negative_ ? -current()[index_].number : current()[index_].number; }

  friend traced operator-(const traced& x) { return x.times(x.is(0) ? 1 : -1); }
  friend traced operator+(const traced& a, const traced& b) {
    if (a.constant() && b.constant()) return a.value() + b.value();
    if (a.is(0)) return b;
    if (b.is(0)) return a;
    const auto [i, j] = std::minmax(a.index_, b.index_);
    if (a.negative_ == b.negative_) return make({op::sum, i, j, 0}).times(a.negative_ ? -1 : 1);
    if (i == j) return 0;
    return make({op::difference, i, j, 0}).times((i == a.index_ ? a : b).negative_ ? -1 : 1);
  }
  friend traced operator-(const traced& a, const traced& b) { return a + -b; }
  friend traced operator*(const traced& a, const traced& b) {
    if (a.constant() && b.constant()) return a.value() * b.value();
    if (a.is(0) || b.is(0)) return 0;
    const int sign = a.negative_ == b.negative_ ? 1 : -1;
    if (a.is(1)) return b.absolute().times(sign);
    if (b.is(1)) return a.absolute().times(sign);
    const auto [i, j] = std::minmax(a.index_, b.index_);
    return make({op::product, i, j, 0}).times(sign);
  }
  friend traced operator/(const traced& a, const traced& b) {
    if (a.constant() && b.constant()) return a.value() / b.value();
    if (a.is(0)) return 0;
    return make({op::quotient, a.index_, b.index_, 0}).times(a.negative_ == b.negative_ ? 1 : -1);
  }
  friend traced& operator+=(traced& a, const traced& b) { return a = a + b; }
  friend traced& operator-=(traced& a, const traced& b) { return a = a - b; }
  friend traced& operator*=(traced& a, const traced& b) { return a = a * b; }
  friend traced& operator/=(traced& a, const traced& b) { return a = a / b; }
  /// Whether these are the same value; x-x == 0 for all x.
  friend bool operator==(const traced& a, const traced& b) {
    return a.index_ == b.index_ && (a.negative_ == b.negative_ || a.is(0));
  }
  /// Comparisons, such as whether a pivot is large enough, are assumed to hold.
  friend bool operator>(const traced&, const traced&) { return true; }
  friend bool operator<(const traced&, const traced&) { return true; }
  friend traced sin(const traced& x) { return make({op::sine, x.index_, 0, 0}).times(x.negative_ ? -1 : 1); }
  friend traced cos(const traced& x) { return make({op::cosine, x.index_, 0, 0}); }
  friend traced sqrt(const traced& x) { return make({op::root, x.index_, 0, 0}); }

 private:
  static traced make(const node& n) {
    traced x(0);
    x.index_ = current().find(n);
    return x;
  }
  traced times(int sign) const {
    traced x = *this;
    x.negative_ ^= sign < 0;
    return x;
  }
  traced absolute() const { return times(negative_ ? -1 : 1); }
  /// Whether this is the number x or -x.
  bool is(double x) const { return constant() && current()[index_].number == x; }

  bool negative_;
  std::size_t index_;
};

}  // namespace straightline

template <>
struct Eigen::NumTraits<straightline::traced> : Eigen::NumTraits<double> {
  using Real = straightline::traced;
  using NonInteger = straightline::traced;
  using Nested = straightline::traced;
  using Literal = double;
};
