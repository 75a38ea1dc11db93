#pragma once

#include <kte/errors.hpp>
#include <kte/math/dual_functions.hpp>
#include <kte/math/dual_number.hpp>

#include <Eigen/Core>

#include <limits>
#include <ostream>

/// Dual numbers: derivatives of anything in this library by automatic differentiation.
namespace kte {

/// The independent variable i of N at the value x: its derivative with respect to itself is 1. Integers become double.
/// Throws `bad_argument` unless 0 <= i < N.
template <int N, class T>
[[nodiscard]] constexpr auto seeded(const T& x, std::type_identity_t<int> i) {
  using S = std::remove_const_t<decltype(real(x))>;
  if (i < 0 || i >= N) [[unlikely]]
    detail::raise<bad_argument>("kte: a dual number has no variable of this index");
  dual<S, N> r(real(x));
  r.derivative[static_cast<std::size_t>(i)] = S(1);
  return r;
}

/// The value and, in brackets, the derivatives.
template <class C, class Traits, class T, int N>
std::basic_ostream<C, Traits>& operator<<(std::basic_ostream<C, Traits>& out, const dual<T, N>& x) {
  out << x.value << " (";
  for (std::size_t i = 0; i < x.derivative.size(); ++i) out << (i == 0 ? "" : " ") << x.derivative[i];
  return out << ")";
}

/// The derivatives of a vector of dual numbers: row i belongs to x[i], column j to variable j.
template <class V>
[[nodiscard]] auto jacobian_of(const Eigen::MatrixBase<V>& x) {
  static_assert(V::IsVectorAtCompileTime, "kte: jacobian_of takes a vector");
  using D = typename V::Scalar;
  const auto& v = x.derived().eval();
  Eigen::Matrix<typename D::scalar, V::SizeAtCompileTime, D::variables> r(x.size(), D::variables);
  for (Eigen::Index i = 0; i < r.rows(); ++i)
    for (Eigen::Index j = 0; j < r.cols(); ++j) r(i, j) = v[i].derivative[static_cast<std::size_t>(j)];
  return r;
}

}  // namespace kte

/// The limits of T.
template <class T, int N>
struct std::numeric_limits<kte::dual<T, N>> : std::numeric_limits<T> {
 private:
  using of_value = std::numeric_limits<T>;
  using D = kte::dual<T, N>;

 public:
  static constexpr D(min)() noexcept { return (of_value::min)(); }
  static constexpr D(max)() noexcept { return (of_value::max)(); }
  static constexpr D lowest() noexcept { return of_value::lowest(); }
  static constexpr D epsilon() noexcept { return of_value::epsilon(); }
  static constexpr D round_error() noexcept { return of_value::round_error(); }
  static constexpr D infinity() noexcept { return of_value::infinity(); }
  static constexpr D quiet_NaN() noexcept { return of_value::quiet_NaN(); }
  static constexpr D signaling_NaN() noexcept { return of_value::signaling_NaN(); }
  static constexpr D denorm_min() noexcept { return of_value::denorm_min(); }
};

namespace Eigen {

template <class T, int N>
struct NumTraits<kte::dual<T, N>> : GenericNumTraits<kte::dual<T, N>> {
  using Real = kte::dual<T, N>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = typename NumTraits<T>::Literal;
  static Real dummy_precision() { return NumTraits<T>::dummy_precision(); }
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = NumTraits<T>::RequireInitialization,
    ReadCost = (N + 1) * NumTraits<T>::ReadCost,
    AddCost = (N + 1) * NumTraits<T>::AddCost,
    MulCost = (2 * N + 1) * NumTraits<T>::MulCost + N * NumTraits<T>::AddCost
  };
};

template <class A, class T, int N, class Op>
requires kte::constant_of<A, T>
struct ScalarBinaryOpTraits<A, kte::dual<T, N>, Op> {
  using ReturnType = kte::dual<T, N>;
};
template <class A, class T, int N, class Op>
requires kte::constant_of<A, T>
struct ScalarBinaryOpTraits<kte::dual<T, N>, A, Op> {
  using ReturnType = kte::dual<T, N>;
};

namespace internal {
/// Eigen's blocked products need both factors in registers of one kind, so products of dual numbers with constants are
/// computed coefficient by coefficient.
template <class L, class R>
concept one_factor_dual = !std::is_same_v<typename L::Scalar, typename R::Scalar> &&
                          (kte::is_dual<typename L::Scalar> || kte::is_dual<typename R::Scalar>);
template <class L, class R>
requires one_factor_dual<L, R>
struct generic_product_impl<L, R, DenseShape, DenseShape, GemmProduct>
    : generic_product_impl<L, R, DenseShape, DenseShape, CoeffBasedProductMode> {
};
template <class L, class R>
requires one_factor_dual<L, R>
struct generic_product_impl<L, R, DenseShape, DenseShape, GemvProduct>
    : generic_product_impl<L, R, DenseShape, DenseShape, CoeffBasedProductMode> {
};
}  // namespace internal

}  // namespace Eigen
