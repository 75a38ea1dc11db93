#pragma once

#include <kte/integrators/motion_space.hpp>
#include <kte/models/detail/rate_derivatives.hpp>

#include <cmath>
#include <limits>
#include <type_traits>

/// Derivatives of functions by states and inputs: by dual numbers, or by differences.
namespace kte::detail {

template <class S>
using matrix_of = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <class S>
using column = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// Whether F is a class whose call operator is a template, such as a lambda with `const auto&`, which accepts dual
/// numbers.
template <class F>
inline constexpr bool takes_any_numbers = std::is_class_v<unwrapped_type<F>> && !requires {
  &unwrapped_type<F>::operator();
};

/// The numbers of y, which is a number, a vec3 or something with size() and operator[].
template <class T, class Y>
column<T> column_of_numbers(const Y& y) {
  if constexpr (requires { y.size(), y[0]; }) {
    column<T> all(static_cast<Eigen::Index>(y.size()));
    for (Eigen::Index i = 0; i < all.size(); ++i) all[i] = T(y[static_cast<std::size_t>(i)]);
    return all;
  } else if constexpr (requires { y.x, y.y, y.z; }) {
    column<T> all(3);
    all << T(y.x), T(y.y), T(y.z);
    return all;
  } else {
    return column<T>::Constant(1, T(y));
  }
}

/// x, with lane i displaced along number first + i, if there is one.
template <class Number, class X>
auto moved_numbers(const X& x, int first) {
  Eigen::Matrix<Number, X::RowsAtCompileTime, 1> moved = x.template cast<Number>();
  for (int j = (std::max)(first, 0); j < (std::min)(first + Number::variables, static_cast<int>(x.size())); ++j)
    moved[j].derivative[static_cast<std::size_t>(j - first)] = typename Number::scalar(1);
  return moved;
}

/// Throws `bad_argument` unless all derivatives are finite.
template <class S>
void check_derivatives(const matrix_of<S>& j, const char* of) {
  if (!all_finite(j.data(), static_cast<std::size_t>(j.size()))) [[unlikely]]
    raise<bad_argument>(std::string("kte: linearize: a derivative of ") + of + " is not finite there");
}

/// dy/dx of y = f(x displaced along `count` directions from `first` on), by dual numbers.
template <class S, class F>
matrix_of<S> derive_in_duals(int rows, int count, const F& f) {
  using number = dual<S, 4>;
  matrix_of<S> j(rows, count);
  for (int first = 0; first < count; first += number::variables) {
    const column<number> y = f(number(), first);
    for (int k = first; k < (std::min)(first + number::variables, count); ++k)
      for (int i = 0; i < rows; ++i) j(i, k) = y[i].derivative[static_cast<std::size_t>(k - first)];
  }
  return j;
}
/// dy/dx by central differences of order 4, for y = f(j, h), with x displaced by h along direction j, whose scale is
/// size(j):
///
///   (8 (f(h) - f(-h)) - (f(2h) - f(-2h)))/(12 h),   h = eps^(1/5) size(j)          (1)
///
/// with an error of about eps^(4/5) (3e-13 in double) of y and of its fifth derivative, in units of size(j).
template <class S, class Size, class F>
matrix_of<S> derive_by_differences(int rows, int count, const Size& size, const F& f) {
  using std::pow;
  matrix_of<S> j(rows, count);
  for (int k = 0; k < count; ++k) {
    const S h = pow(std::numeric_limits<S>::epsilon(), S(1) / S(5)) * size(k);
    const column<S> inner = f(k, h) - f(k, S(-h)), outer = f(k, S(2 * h)) - f(k, S(-2 * h));
    j.col(k) = (S(8) * inner - outer) / (S(12) * h);  // (1)
  }
  return j;
}
/// The size of a number x.
template <class S>
S size_of_number(const S& x) {
  using std::abs;
  return abs(x) < S(1) ? S(1) : S(abs(x));
}
/// x displaced by h along number j of its displacement.
template <class X>
X displaced_along(std::span<const freedom> freedoms, int rates, const X& x, int j, const typename X::Scalar& h) {
  using S = typename X::Scalar;
  column<S> d = column<S>::Zero(rates);
  d[j] = h;
  X moved = x;
  int positions = 0;
  for (const freedom& f : freedoms) {
    displace_one<S>(f, x, d, moved);
    positions += nv_of(f.what);
  }
  if (j >= positions) moved[x.size() - rates + j] += h;
  return moved;
}

}  // namespace kte::detail
