#pragma once

#include <kte/control/detail/derive.hpp>
#include <kte/control/linear_system.hpp>
#include <kte/models/controlled.hpp>
#include <kte/models/state_space.hpp>

#include <algorithm>

/// Linear systems near a state (control/linear_system.hpp): A, B, C, D of x' = f(t, x, u), y = h(t, x, u).
namespace kte {

namespace detail {
template <class M>
concept linearizable_model = requires(const M& m) {
  typename M::state;
  m.freedoms(), m.input(), m.chain();
};

/// C, D and y0 of a model.
template <class Model, class S>
void derive_outputs(Model& m, const S& t, const typename Model::state& x, linear_system<S>& r) {
  const int n = m.rates(), nu = static_cast<int>(m.input().size());
  r.y0 = column_of_numbers<S>(m.computeOutput(t, x));
  const int rows = static_cast<int>(r.y0.size());
  const auto numbers = [&](auto number, int first) {  // functions of x itself
    return column<decltype(number)>(moved_along<decltype(number)>(m.freedoms(), n, x, first).head(rows));
  };
  if constexpr (requires { m.template in_scalar<S>(); }) {
    if constexpr (Model::has_output()) {
      const auto u = m.input();
      const auto both = derive_in_duals<S>(rows, n + nu, [&](auto number, int first) {
        using T = decltype(number);
        auto in_duals = m.template in_scalar<T>();
        in_duals.setInput(moved_numbers<T>(u, first - n));
        return column_of_numbers<T>(in_duals.computeOutput(T(t), moved_along<T>(m.freedoms(), n, x, first)));
      });
      check_derivatives<S>(both, "the output");
      r.C = both.leftCols(n), r.D = both.rightCols(nu);
      return;
    }
  } else if (m.has_output()) {
    const auto u = m.input();
    typename Model::rate sizes(n);
    m.magnitudes(x, sizes);
    const auto size_of = [&](int j) { return size_of_number<S>(j < n ? S(sizes[j]) : S(u[j - n])); };
    const auto both = derive_by_differences<S>(rows, n + nu, size_of, [&](int j, const S& h) {
      auto changed = u;
      if (j >= n) changed[j - n] += h;
      m.setInput(changed);
      return column_of_numbers<S>(m.computeOutput(t, j < n ? displaced_along(m.freedoms(), n, x, j, h) : x));
    });
    m.setInput(u);
    check_derivatives<S>(both, "the output");
    r.C = both.leftCols(n), r.D = both.rightCols(nu);
    return;
  }
  r.C = derive_in_duals<S>(rows, n, numbers);
  r.D.setZero(rows, nu);
}
}  // namespace detail

/// Linearization of a model about the state x, the inputs set in the model and the time t, s:
///
///   x' of x (+) d  =  x_dot + A d + B du,     A = dx'/dd,  B = dx'/du  at d = 0, du = 0          (1)
///
/// for models of static and runtime chains. For coordinates that are numbers, d = x - x0. For rotations and poses, d is
/// in the tangent space, so that A is 2 n x 2 n (plus internal states) although x has more numbers: with d = (u, phi,
/// ...) the rotation is R exp [phi]x and the position p + R u, in moving axes. There d' = x_dot, and
///
///   phi' = w + phi x w/2 + ...,   u' = exp [phi]x v          (2)
///
/// so that A has -[w]x/2 in rows of phi and -[v]x in rows of u. `displacement(model, x0, x)` computes d.
///
/// The rows of accelerations in A are analytical (`forward_dynamics_derivatives`). Derivatives by inputs and internal
/// states are exact, by dual numbers. y is the result of `computeOutput`. For static chains, C and D are computed by
/// dual numbers, so the function of `with_output` must accept states of any scalar. For runtime chains this function
/// accepts double only, and C and D are differences of order 4, with an error of about 1e-12. The state need not be an
/// equilibrium: x_dot and y0 are those of the model there. Throws what `forward_dynamics_derivatives` throws, and
/// `bad_argument` for an x or u of wrong size and for numbers that are not finite.
template <detail::linearizable_model Model, class X, class S = typename Model::state::Scalar>
[[nodiscard]] linear_system<S> linearize(const Model& model, const Eigen::MatrixBase<X>& x,
                                         const std::type_identity_t<S>& t = S(0)) {
  Model m = model;
  check_size(static_cast<std::size_t>(m.state_size()), x.derived(), "x", "numbers of a state");
  const typename Model::state at = x;
  linear_system<S> r;
  const auto& rate = m.computeStateRate(t, at);
  r.x_dot.resize(rate.size());
  std::copy_n(rate.data(), rate.size(), r.x_dot.data());  // because `=` causes warnings of g++ 12 for AVX-512
  const auto both = m.jacobian_with_inputs(t, at);
  r.A = both.leftCols(r.x_dot.size());
  r.B = both.rightCols(m.input().size());
  detail::derive_outputs(m, t, at, r);
  return r;
}
/// Linearization of a model about the state x, inputs u and the time t, s.
template <detail::linearizable_model Model, class X, indexable U, class S = typename Model::state::Scalar>
[[nodiscard]] linear_system<S> linearize(const Model& model, const Eigen::MatrixBase<X>& x, const U& u,
                                         const std::type_identity_t<S>& t = S(0)) {
  Model m = model;
  m.setInput(u);
  return linearize(m, x, t);
}

/// Linearization of a closed loop: a model with its control law, with the states c of the law after those of the model:
///
///   A = | A + B du/dd    B du/dc |     C = (C + D du/dd   D du/dc)          (3)
///       | dc'/dd         dc'/dc  |
///
/// There are no inputs: B and D have no columns. Laws that accept vectors of any scalar, such as lambdas with `const
/// auto& x`, are differentiated by dual numbers. Laws for double are differentiated by differences of order 4, with a
/// relative error of about 1e-12.
template <class Model, class Law, class Rates, int N, class X, class S = typename controlled<Model, Law, Rates, N>::S>
[[nodiscard]] linear_system<S> linearize(const controlled<Model, Law, Rates, N>& closed, const Eigen::MatrixBase<X>& x,
                                         const std::type_identity_t<S>& t = S(0)) {
  using namespace detail;
  auto loop = closed;
  check_size(static_cast<std::size_t>(loop.state_size()), x.derived(), "x", "numbers of a state");
  const typename controlled<Model, Law, Rates, N>::state at = x;
  linear_system<S> r;
  r.x_dot = loop.computeStateRate(t, at);  // also sets the inputs
  const auto own = loop.own_part(at);
  const auto open = linearize(loop.model(), own, t);
  const Eigen::Matrix<S, N, 1> c = at.template tail<N>();
  const int n = loop.model().rates(), nu = static_cast<int>(open.B.cols());
  const auto law = [&](const auto& state, const auto& kept) {  // u, c'
    using T = typename std::remove_cvref_t<decltype(state)>::Scalar;
    if constexpr (N == 0) {
      (void)kept;
      return column_of_numbers<T>(loop.law()(t, state));
    } else {
      column<T> both(nu + N);
      both << column_of_numbers<T>(loop.law()(t, state, kept)), column_of_numbers<T>(loop.law_rates()(t, state, kept));
      return both;
    }
  };
  matrix_of<S> by_states;
  if constexpr (takes_any_numbers<Law> && (N == 0 || takes_any_numbers<Rates>)) {
    by_states = derive_in_duals<S>(nu + N, n + N, [&](auto number, int first) {
      using T = decltype(number);
      return law(moved_along<T>(loop.model().freedoms(), n, own, first), moved_numbers<T>(c, first - n));
    });
  } else {
    const auto size_of = [&](int j) { return size_of_number<S>(j < n ? S(own[own.size() - n + j]) : S(c[j - n])); };
    by_states = derive_by_differences<S>(nu + N, n + N, size_of, [&](int j, const S& h) {
      auto kept = c;
      if (j >= n) kept[j - n] += h;
      return law(j < n ? displaced_along(loop.model().freedoms(), n, own, j, h) : own, kept);
    });
  }
  check_derivatives<S>(by_states, "the law");
  r.A.setZero(n + N, n + N);
  r.A.topLeftCorner(n, n) = open.A;
  r.A.topRows(n) += open.B * by_states.topRows(nu);
  r.A.bottomRows(N) = by_states.bottomRows(N);
  r.C.setZero(open.C.rows(), n + N);
  r.C.leftCols(n) = open.C;
  r.C += open.D * by_states.topRows(nu);
  r.B.resize(n + N, 0), r.D.resize(open.C.rows(), 0);
  r.y0 = open.y0;
  return r;
}

/// Linearization of any x' = f(t, x, u), y = h(t, x, u) with Eigen vectors x and u; without h, y = x. Uses dual numbers
/// if f accepts vectors of any scalar (`const auto& x`), otherwise differences of order 4, with a relative error of
/// about 1e-12.
template <class F, class H, class X, class U, class S = typename X::Scalar>
requires(!detail::linearizable_model<F>) linear_system<S> linearize(F f, H h, const Eigen::MatrixBase<X>& x,
                                                                    const Eigen::MatrixBase<U>& u,
                                                                    const std::type_identity_t<S>& t = S(0)) {
  using namespace detail;
  const typename X::PlainObject x0 = x;
  const typename U::PlainObject u0 = u;
  const int n = static_cast<int>(x0.size()), nu = static_cast<int>(u0.size());
  const auto derive = [&](auto& g, column<S>& value, matrix_of<S>& by_x, matrix_of<S>& by_u) {
    value = column_of_numbers<S>(g(t, x0, u0));
    const int rows = static_cast<int>(value.size());
    matrix_of<S> both;
    if constexpr (takes_any_numbers<std::remove_reference_t<decltype(g)>>) {
      both = derive_in_duals<S>(rows, n + nu, [&](auto number, int first) {
        using T = decltype(number);
        return column_of_numbers<T>(g(t, moved_numbers<T>(x0, first), moved_numbers<T>(u0, first - n)));
      });
    } else {
      const auto size_of = [&](int j) { return size_of_number<S>(j < n ? S(x0[j]) : S(u0[j - n])); };
      both = derive_by_differences<S>(rows, n + nu, size_of, [&](int j, const S& step) {
        auto at = x0;
        auto under = u0;
        (j < n ? at[j] : under[j - n]) += step;
        return column_of_numbers<S>(g(t, at, under));
      });
    }
    check_finite(value, static_cast<std::size_t>(rows), "kte: linearize: a result of the function is not finite");
    check_derivatives<S>(both, "the function");
    by_x = both.leftCols(n), by_u = both.rightCols(nu);
  };
  linear_system<S> r;
  derive(f, r.x_dot, r.A, r.B);
  if (r.x_dot.size() != n)
    raise<bad_argument>("kte: linearize: f gives " + std::to_string(r.x_dot.size()) + " rates, the state has " +
                        std::to_string(n) + " numbers");
  derive(h, r.y0, r.C, r.D);
  return r;
}
template <class F, class X, class U, class S = typename X::Scalar>
requires(!detail::linearizable_model<F>) linear_system<S> linearize(F f, const Eigen::MatrixBase<X>& x,
                                                                    const Eigen::MatrixBase<U>& u,
                                                                    const std::type_identity_t<S>& t = S(0)) {
  return linearize(
      std::move(f), [](const auto&, const auto& state, const auto&) { return state; }, x, u, t);
}

/// The displacement d from x0 to x, in the coordinates of the matrices of `linearize`; rotations take the shorter way.
/// For numbers d = x - x0. Throws `bad_argument` for states of wrong size.
template <class Model, class X0, class X>
[[nodiscard]] typename Model::rate displacement(const Model& model, const Eigen::MatrixBase<X0>& x0,
                                                const Eigen::MatrixBase<X>& x) {
  using S = typename Model::state::Scalar;
  for (const auto size : {x0.size(), x.size()})
    if (size != model.state_size()) [[unlikely]]
      detail::raise_size(static_cast<std::size_t>(size), static_cast<std::size_t>(model.state_size()), "x",
                         "numbers of a state");
  const typename Model::state from = x0, to = x;
  typename Model::rate d(model.rates());
  const Eigen::Index rest = model.velocity_count() + model.internals();
  for (const detail::freedom& f : model.freedoms()) detail::displacement_between<S>(f, from, to, d);
  d.tail(rest) = to.tail(rest) - from.tail(rest);
  return d;
}

}  // namespace kte
