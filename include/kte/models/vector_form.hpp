#pragma once

#include <kte/integrators/motion_space.hpp>
#include <kte/models/state_space.hpp>

namespace kte {

namespace detail {
/// Whether a model fills a matrix J with its Jacobian.
template <class Model, class X, class J>
concept fills_jacobian = requires(Model& m, const X& x, J& j) {
  requires std::is_same_v<J, typename Model::jacobian_matrix>;
  m.jacobian(typename X::Scalar(0), x, j);
};
}  // namespace detail

/// A model with the rates of all numbers of x, for methods that accept vectors only (`adams`, `bdf`):
///
///   x' = (q', v', z'),   q' = v for numbers, R v for positions, q (0, w/2) for quaternions q
///
///   kte::adams solver(kte::vector_form(std::cref(model)), 0.0, model.make_x(q, v));
///
/// Accepts static and runtime chains, with or without rotations. The length of a quaternion has no effect on the model;
/// it drifts by the integration error. For chains with closed loops, states are projected onto the loops at the ends of
/// steps and between (integrators/motion_space.hpp); quaternions then have length 1.
template <class F>
class vector_form {
  using model = detail::unwrapped_type<F>;
  static constexpr bool settles = detail::settles_states<model, typename model::state>;

 public:
  using state = typename model::state;
  using S = typename state::Scalar;

  explicit vector_form(F f) : f_(std::move(f)) {}

  const state& operator()(const S& t, const state& x) {
    auto& m = detail::unwrapped(f_);
    const auto& r = m(t, x);
    if (x_dot_.size() != x.size()) x_dot_ = x;
    put_rate(m, x, r, x_dot_);
    return x_dot_;
  }
  /// The Jacobian of the model, if all its coordinates are numbers. Returns whether it is available.
  template <class J>
  requires(detail::fills_jacobian<model, state, J>) bool jacobian(const S& t, const state& x, J& j) {
    auto& m = detail::unwrapped(f_);
    for (const detail::freedom& f : m.freedoms())
      if (f.what != kind::gen) return false;
    if constexpr (std::is_same_v<decltype(m.jacobian(t, x, j)), bool>) {
      return m.jacobian(t, x, j);
    } else {
      m.jacobian(t, x, j);
      return true;
    }
  }

  // ---- chains with loops (integrators/motion_space.hpp); no effect for other chains
  /// Whether the chain has closures of loops.
  [[nodiscard]] bool has_loops() const {
    if constexpr (settles) return detail::unwrapped(f_).has_loops();
    return false;
  }
  /// The number of rigid contacts.
  [[nodiscard]] int contacts() const {
    if constexpr (requires(const model& m) { m.contacts(); }) return detail::unwrapped(f_).contacts();
    return 0;
  }
  /// The time of the next calls of `begin_step` and `settle`.
  void settle_at(const S& t) const requires(settles) {
    if constexpr (requires { detail::unwrapped(f_).settle_at(t); }) detail::unwrapped(f_).settle_at(t);
  }
  /// Chooses the independent rows of closures for the step from x0. Throws `bad_argument` if x0 is off the loops.
  void begin_step(const state& x0) const requires(settles) { detail::unwrapped(f_).begin_step(x0); }
  /// Projects x, the end of a step from x0 or a state within it, onto the loops. Throws `bad_argument`, naming the
  /// closure that does not close.
  void settle(const state& x0, state& x) const requires(settles) {
    const auto& m = detail::unwrapped(f_);
    if (!m.has_loops() && !detail::has_rigid_contacts(m)) return;
    rate d(m.rates());
    const S *from = x0.data(), *to = x.data();
    for (const detail::freedom& f : m.freedoms()) detail::displacement_between<S>(f, from, to, d);
    const Eigen::Index rest = m.rates() - m.velocities_of(x0).size();
    d.tail(rest) = x.tail(rest) - x0.tail(rest);
    m.settle(x0, d, x);
  }
  /// Removes from a change e of the numbers of x0 the part that `settle` would remove.
  void tangential(const state& x0, state& e) const requires(settles) {
    const auto& m = detail::unwrapped(f_);
    if (!m.has_loops() && !detail::has_rigid_contacts(m)) return;
    rate r(m.rates());
    for (const detail::freedom& f : m.freedoms()) detail::velocity_of_one<S>(f, x0.data(), e.data(), r);
    const Eigen::Index rest = m.rates() - m.velocities_of(x0).size();
    r.tail(rest) = e.tail(rest);
    m.tangential(x0, r);
    put_rate(m, x0, r, e);
  }
  /// Throws `bad_argument` where the step from x0 ends too near to a singular configuration.
  void check_end(const state& x0, const state& next) const requires(settles) {
    const auto& m = detail::unwrapped(f_);
    if constexpr (requires { m.check_end(x0, next); }) m.check_end(x0, next);
  }
  /// The relative distance of x0, where a step begins, from singular configurations of the loops.
  [[nodiscard]] double singular_distance(const state& x0) const requires(settles) {
    const auto& m = detail::unwrapped(f_);
    if constexpr (requires { m.singular_distance(x0); }) {
      return m.singular_distance(x0);
    } else {
      return 1;
    }
  }

 private:
  using rate = typename model::rate;

  /// The numbers of q' and the rest of r, at x.
  template <class R>
  static void put_rate(const model& m, const state& x, const R& r, state& out) {
    for (const detail::freedom& f : m.freedoms()) detail::rate_of_one<S>(f, x.data(), r.data(), out);
    const Eigen::Index rest = r.size() - m.velocities_of(x).size();
    for (Eigen::Index i = 1; i <= rest; ++i) out[out.size() - i] = r[r.size() - i];
  }

  F f_;
  state x_dot_ = state::Zero(state::RowsAtCompileTime == Eigen::Dynamic ? 0 : state::RowsAtCompileTime);
};

}  // namespace kte
