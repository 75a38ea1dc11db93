#include "digits50.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <new>
#include <ostream>

namespace kte::test::number_type {

using number =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type, boost::multiprecision::et_off>;

struct digits50_access {
  static const number& of(const digits50& x) { return *std::launder(reinterpret_cast<const number*>(x.bytes_)); }
  static number& of(digits50& x) { return *std::launder(reinterpret_cast<number*>(x.bytes_)); }
  static digits50 from(const number& x) {
    digits50 y;
    new (y.bytes_) number(x);
    return y;
  }
  static void put(digits50& x, const number& value) { new (x.bytes_) number(value); }
};
static_assert(sizeof(number) <= sizeof(digits50) && alignof(number) <= alignof(digits50));
static_assert(std::is_trivially_destructible_v<number>);

namespace {
const number& of(const digits50& x) { return digits50_access::of(x); }
digits50 from(const number& x) { return digits50_access::from(x); }
}  // namespace

digits50::digits50() { digits50_access::put(*this, number()); }
digits50::digits50(double x) { digits50_access::put(*this, number(x)); }
digits50::digits50(long double x) { digits50_access::put(*this, number(x)); }
digits50::digits50(const char* x) { digits50_access::put(*this, number(x)); }
digits50::operator double() const { return of(*this).convert_to<double>(); }
digits50::operator long double() const { return of(*this).convert_to<long double>(); }
digits50::operator int() const { return of(*this).convert_to<int>(); }
digits50::operator std::string() const { return of(*this).str(70); }
digits50& digits50::operator+=(const digits50& y) {
  digits50_access::of(*this) += of(y);
  return *this;
}
digits50& digits50::operator-=(const digits50& y) {
  digits50_access::of(*this) -= of(y);
  return *this;
}
digits50& digits50::operator*=(const digits50& y) {
  digits50_access::of(*this) *= of(y);
  return *this;
}
digits50& digits50::operator/=(const digits50& y) {
  digits50_access::of(*this) /= of(y);
  return *this;
}
digits50 digits50::operator-() const { return from(-of(*this)); }
std::partial_ordering operator<=>(const digits50& x, const digits50& y) {
  const number &a = of(x), &b = of(y);
  return a < b    ? std::partial_ordering::less
         : a > b  ? std::partial_ordering::greater
         : a == b ? std::partial_ordering::equivalent
                  : std::partial_ordering::unordered;
}
std::ostream& operator<<(std::ostream& out, const digits50& x) { return out << of(x); }
#define KTE_FUNCTION(f) \
  digits50 f(const digits50& x) { return from(f(of(x))); }
KTE_FUNCTION(abs)
KTE_FUNCTION(sqrt)
KTE_FUNCTION(cbrt)
KTE_FUNCTION(sin)
KTE_FUNCTION(cos)
KTE_FUNCTION(tan)
KTE_FUNCTION(asin)
KTE_FUNCTION(acos)
KTE_FUNCTION(atan)
KTE_FUNCTION(sinh)
KTE_FUNCTION(cosh)
KTE_FUNCTION(tanh)
KTE_FUNCTION(exp)
KTE_FUNCTION(log)
KTE_FUNCTION(floor)
KTE_FUNCTION(ceil)
KTE_FUNCTION(round)
KTE_FUNCTION(trunc)
#undef KTE_FUNCTION
digits50 atan2(const digits50& y, const digits50& x) { return from(atan2(of(y), of(x))); }
digits50 pow(const digits50& x, const digits50& y) { return from(pow(of(x), of(y))); }
digits50 ldexp(const digits50& x, int n) { return from(ldexp(of(x), n)); }
digits50 frexp(const digits50& x, int* n) { return from(frexp(of(x), n)); }
bool isfinite(const digits50& x) { return (boost::multiprecision::isfinite)(of(x)); }
bool isnan(const digits50& x) { return (boost::multiprecision::isnan)(of(x)); }
bool isinf(const digits50& x) { return (boost::multiprecision::isinf)(of(x)); }
bool signbit(const digits50& x) { return (boost::multiprecision::signbit)(of(x)); }
digits50 digits50_limits::epsilon() { return from(std::numeric_limits<number>::epsilon()); }
digits50 digits50_limits::min() { return from((std::numeric_limits<number>::min)()); }
digits50 digits50_limits::max() { return from((std::numeric_limits<number>::max)()); }
digits50 digits50_limits::infinity() { return from(std::numeric_limits<number>::infinity()); }
digits50 digits50_limits::nan() { return from(std::numeric_limits<number>::quiet_NaN()); }

}  // namespace kte::test::number_type
