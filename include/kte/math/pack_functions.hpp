#pragma once

#include <kte/math/pack.hpp>
#include <kte/math/select.hpp>
#include <kte/math/sincos.hpp>

#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <limits>

/// Functions of packs, and their traits for std and Eigen.
namespace kte {

/// The square root of each element.
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> sqrt(const pack<T, N, A>& x) {
  return x.map([](const auto& a) KTE_INLINE_LAMBDA { return pack<T, N, A>::register_functions::root(a); }, x);
}
/// The absolute value of each element.
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> abs(const pack<T, N, A>& x) {
  return x.map([](const auto& a) KTE_INLINE_LAMBDA { return pack<T, N, A>::register_functions::magnitude(a); }, x);
}
/// The absolute value of each element.
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> fabs(const pack<T, N, A>& x) {
  return abs(x);
}
/// The function of each element, computed one by one.
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> exp(pack<T, N, A> x) {
  for (std::size_t i = 0; i < std::size_t{N}; ++i) x.set(i, std::exp(x[i]));
  return x;
}
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> asin(pack<T, N, A> x) {
  for (std::size_t i = 0; i < std::size_t{N}; ++i) x.set(i, std::asin(x[i]));
  return x;
}
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> atan2(pack<T, N, A> y, const pack<T, N, A>& x) {
  for (std::size_t i = 0; i < std::size_t{N}; ++i) y.set(i, std::atan2(y[i], x[i]));
  return y;
}
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> pow(pack<T, N, A> x, double exponent) {
  for (std::size_t i = 0; i < std::size_t{N}; ++i) x.set(i, std::pow(x[i], static_cast<T>(exponent)));
  return x;
}
/// The smaller, or larger, of each pair of elements, as std::min and std::max.
template <class T, int N, class A>
KTE_INLINE pack<T, N, A>(min)(const pack<T, N, A>& a, const pack<T, N, A>& b) {
  return select(b < a, b, a);
}
template <class T, int N, class A>
KTE_INLINE pack<T, N, A>(max)(const pack<T, N, A>& a, const pack<T, N, A>& b) {
  return select(a < b, b, a);
}

namespace detail {

/// c[0] z^n + ... + c[n]
template <class R, class T, std::same_as<T>... C>
KTE_INLINE R horner(const R& z, T first, T second, C... c) {
  R sum = z * first + second;
  ((sum = sum * z + c), ...);
  return sum;
}

/// The constants of sines and cosines; the formulas are those of `sincos4`.
template <class T>
struct sincos_numbers;
template <>
struct sincos_numbers<double> {
  static constexpr double largest = 1e5;                         // largest angle of the reduction
  static constexpr double to_integer = 6755399441055744.0;       // 1.5 2^52
  static constexpr double half_pi[]{1.57079632673412561417e+00,  // 33 bits, 33 bits, the rest
                                    6.07710050630396597660e-11, 2.02226624879595063154e-21};
  template <class R>
  KTE_INLINE static R p(const R& z) {
    return horner(z, 1.58962301576546568060e-10, -2.50507477628578072866e-8, 2.75573136213857245213e-6,
                  -1.98412698295895385996e-4, 8.33333333332211858878e-3, -1.66666666666666307295e-1);
  }
  template <class R>
  KTE_INLINE static R q(const R& z) {
    return horner(z, -1.13585365213876817300e-11, 2.08757008419747316778e-9, -2.75573141792967388112e-7,
                  2.48015872888517045348e-5, -1.38888888888730564116e-3, 4.16666666666665929218e-2);
  }
};
template <>
struct sincos_numbers<float> {
  static constexpr float largest = 8192;
  static constexpr float to_integer = 12582912;                                                     // 1.5 2^23
  static constexpr float half_pi[]{1.5703125f, 4.837512969970703125e-4f, 7.54978995489188216e-8f};  // 8, 11, 24 bits
  template <class R>
  KTE_INLINE static R p(const R& z) {
    return horner(z, -1.9515295891e-4f, 8.3321608736e-3f, -1.6666654611e-1f);
  }
  template <class R>
  KTE_INLINE static R q(const R& z) {
    return horner(z, 2.443315711809948e-5f, -1.388731625493765e-3f, 4.166664568298827e-2f);
  }
};

/// Sine and cosine for |x| <= largest, in one register.
template <class T, class Bits, class Register>
KTE_INLINE void reduced_sincos(const Register& x, Register& sine, Register& cosine) {
  using R = Register;
  using numbers = sincos_numbers<T>;
  constexpr int to_sign = sizeof(T) * 8 - 2;
  const R shifted = x * T(0.63661977236758134308) + numbers::to_integer;
  const Bits k = __builtin_bit_cast(Bits, shifted);
  const R n = shifted - numbers::to_integer;
  const R r = ((x - n * numbers::half_pi[0]) - n * numbers::half_pi[1]) - n * numbers::half_pi[2];
  const R z = r * r;
  const R sine_of_r = numbers::p(z) * (z * r) + r;
  const R cosine_of_r = (numbers::q(z) * z - T(0.5)) * z + T(1);
  const Bits s = __builtin_bit_cast(Bits, sine_of_r);
  const Bits c = __builtin_bit_cast(Bits, cosine_of_r);
  constexpr bits_of<T> one = 1, sign = one << (to_sign + 1);
  const Bits exchange = (s ^ c) & -(k & one);  // all of it for odd k, else nothing
  const Bits sine_bits = s ^ exchange ^ ((k << to_sign) & sign);
  const Bits cosine_bits = c ^ exchange ^ (((k + one) << to_sign) & sign);
  sine = __builtin_bit_cast(R, sine_bits);
  cosine = __builtin_bit_cast(R, cosine_bits);
}

/// Computes lanes that are too large, infinite or NaN. Other lanes are unchanged, because a state must not depend on
/// its neighbours.
template <class P>
[[gnu::cold, gnu::noinline]] void sincos_of_large(const P& x, P& sine, P& cosine) {
  using T = typename P::value_type;
  for (std::size_t i = 0; i < std::size_t{P::lanes}; ++i) {
    const double angle = static_cast<double>(x[i]);
    if (std::fabs(angle) <= static_cast<double>(sincos_numbers<T>::largest)) continue;
    sine.set(i, static_cast<T>(std::sin(angle)));
    cosine.set(i, static_cast<T>(std::cos(angle)));
  }
}

template <class P, std::size_t... I>
KTE_INLINE void sincos_of_pack(const P& x, P& sine, P& cosine, std::index_sequence<I...>) {
  P s, c;
  (reduced_sincos<typename P::value_type, typename P::register_bits>(x.in_register(I), s.in_register(I),
                                                                     c.in_register(I)),
   ...);
  if (!all(abs(x) <= P(sincos_numbers<typename P::value_type>::largest))) [[unlikely]] {
    const P x_in_memory = x;  // copies, because x itself would otherwise have to live in memory
    P s_in_memory = s, c_in_memory = c;
    sincos_of_large(x_in_memory, s_in_memory, c_in_memory);
    s = s_in_memory, c = c_in_memory;
  }
  sine = s, cosine = c;
}

}  // namespace detail

/// Sines and cosines of angles, rad, of each element; a result does not depend on the other elements. Absolute error
/// for double below 2.3e-16, for float below 1e-7.
template <class T, int N, class A>
KTE_INLINE void sincos(const pack<T, N, A>& angle, pack<T, N, A>& sine, pack<T, N, A>& cosine) {
  detail::sincos_of_pack(angle, sine, cosine, typename pack<T, N, A>::registers{});
}
/// The sine of each element, rad.
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> sin(const pack<T, N, A>& angle) {
  pack<T, N, A> s, c;
  sincos(angle, s, c);
  return s;
}
/// The cosine of each element, rad.
template <class T, int N, class A>
[[nodiscard]] KTE_INLINE pack<T, N, A> cos(const pack<T, N, A>& angle) {
  pack<T, N, A> s, c;
  sincos(angle, s, c);
  return c;
}

}  // namespace kte

/// The limits of one element.
template <class T, int N, class A>
class std::numeric_limits<kte::pack<T, N, A>> : public std::numeric_limits<T> {
  using pack = kte::pack<T, N, A>;
  using lane = std::numeric_limits<T>;

 public:
  static pack(min)() { return (lane::min)(); }
  static pack(max)() { return (lane::max)(); }
  static pack lowest() { return lane::lowest(); }
  static pack epsilon() { return lane::epsilon(); }
  static pack round_error() { return lane::round_error(); }
  static pack infinity() { return lane::infinity(); }
  static pack quiet_NaN() { return lane::quiet_NaN(); }
  static pack signaling_NaN() { return lane::signaling_NaN(); }
  static pack denorm_min() { return lane::denorm_min(); }
};

template <class T, int N, class A>
struct Eigen::NumTraits<kte::pack<T, N, A>> : Eigen::GenericNumTraits<kte::pack<T, N, A>> {
  enum { RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = 1 };
};
