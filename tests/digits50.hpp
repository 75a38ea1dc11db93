#pragma once

#include <Eigen/Core>

#include <compare>
#include <concepts>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>
#include <type_traits>

namespace kte::test::number_type {

/// Numbers of 50 digits (Boost's cpp_bin_float_50), whose operations are compiled once for all tests (digits50.cpp):
/// the templates of Boost, compiled again in each of 60 files, took a third of the time.
class digits50 {
 public:
  digits50();  // zero
  digits50(double x);
  digits50(long double x);
  template <std::integral A>
  digits50(A x) : digits50(static_cast<long double>(x)) {}
  explicit digits50(const char* decimals);
  explicit digits50(const std::string& decimals) : digits50(decimals.c_str()) {}

  explicit operator double() const;
  explicit operator long double() const;
  explicit operator int() const;
  explicit operator std::string() const;  // exact for who reads it at up to 70 digits
  explicit operator float() const { return static_cast<float>(static_cast<double>(*this)); }

  digits50& operator+=(const digits50& y);
  digits50& operator-=(const digits50& y);
  digits50& operator*=(const digits50& y);
  digits50& operator/=(const digits50& y);
  digits50 operator-() const;
  digits50 operator+() const { return *this; }
  friend digits50 operator+(digits50 x, const digits50& y) { return x += y; }
  friend digits50 operator-(digits50 x, const digits50& y) { return x -= y; }
  friend digits50 operator*(digits50 x, const digits50& y) { return x *= y; }
  friend digits50 operator/(digits50 x, const digits50& y) { return x /= y; }
  friend bool operator==(const digits50& x, const digits50& y) { return x <=> y == 0; }
  friend std::partial_ordering operator<=>(const digits50& x, const digits50& y);
  friend std::ostream& operator<<(std::ostream& out, const digits50& x);

  friend digits50 abs(const digits50& x);
  friend digits50 fabs(const digits50& x) { return abs(x); }
  friend digits50 sqrt(const digits50& x);
  friend digits50 cbrt(const digits50& x);
  friend digits50 sin(const digits50& x);
  friend digits50 cos(const digits50& x);
  friend digits50 tan(const digits50& x);
  friend digits50 asin(const digits50& x);
  friend digits50 acos(const digits50& x);
  friend digits50 atan(const digits50& x);
  friend digits50 atan2(const digits50& y, const digits50& x);
  friend digits50 sinh(const digits50& x);
  friend digits50 cosh(const digits50& x);
  friend digits50 tanh(const digits50& x);
  friend digits50 exp(const digits50& x);
  friend digits50 log(const digits50& x);
  friend digits50 pow(const digits50& x, const digits50& y);
  friend digits50 ldexp(const digits50& x, int n);
  friend digits50 frexp(const digits50& x, int* n);
  friend digits50 floor(const digits50& x);
  friend digits50 ceil(const digits50& x);
  friend digits50 round(const digits50& x);
  friend digits50 trunc(const digits50& x);
  friend bool isfinite(const digits50& x);
  friend bool isnan(const digits50& x);
  friend bool isinf(const digits50& x);
  friend bool signbit(const digits50& x);

 private:
  alignas(16) unsigned char bytes_[64];
  friend struct digits50_access;
};

struct digits50_limits {
  static digits50 epsilon();
  static digits50 min();
  static digits50 max();
  static digits50 infinity();
  static digits50 nan();
};

}  // namespace kte::test::number_type

namespace kte::test {
using number_type::digits50;
}

template <>
struct std::numeric_limits<kte::test::digits50> {
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false,
                        has_infinity = true, has_quiet_NaN = true, is_iec559 = false;
  static constexpr int digits = 168, digits10 = 50, max_digits10 = 52, radix = 2;
  static constexpr int max_exponent = 262143, min_exponent = -262143;
  static kte::test::digits50 epsilon() { return kte::test::number_type::digits50_limits::epsilon(); }
  static kte::test::digits50 min() { return kte::test::number_type::digits50_limits::min(); }
  static kte::test::digits50 max() { return kte::test::number_type::digits50_limits::max(); }
  static kte::test::digits50 lowest() { return -max(); }
  static kte::test::digits50 infinity() { return kte::test::number_type::digits50_limits::infinity(); }
  static kte::test::digits50 quiet_NaN() { return kte::test::number_type::digits50_limits::nan(); }
};

template <>
struct Eigen::NumTraits<kte::test::digits50> : Eigen::GenericNumTraits<kte::test::digits50> {
  using Real = kte::test::digits50;
  using NonInteger = kte::test::digits50;
  using Literal = kte::test::digits50;
  using Nested = kte::test::digits50;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 8,
    AddCost = 32,
    MulCost = 64
  };
  static Real dummy_precision() { return 1000 * epsilon(); }
};
