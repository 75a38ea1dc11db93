#pragma once

#include <kte/integrators/motion_space.hpp>
#include <kte/models/state_space.hpp>

namespace kte {

/// A model with the rates of all numbers of x, for methods that accept vectors only (`adams`, `bdf`):
///
///   x' = (q', v', z'),   q' = v for numbers, R v for positions, q (0, w/2) for quaternions q
///
///   kte::adams solver(kte::vector_form(std::cref(model)), 0.0, model.make_x(q, v));
///
/// Accepts static and runtime chains, with or without rotations. The length of a quaternion has no effect on the model;
/// it drifts by the integration error. Throws `bad_argument` for a chain with closed loops.
template <class F>
class vector_form {
  using model = detail::unwrapped_type<F>;

 public:
  using state = typename model::state;
  using S = typename state::Scalar;

  explicit vector_form(F f) : f_(std::move(f)) {
    if constexpr (requires { detail::unwrapped(f_).has_loops(); })
      if (detail::unwrapped(f_).has_loops())
        throw bad_argument(
            "kte: states of closed loops are corrected at the ends of steps, which adams and bdf cannot do: use a "
            "one-step method");
  }

  const state& operator()(const S& t, const state& x) {
    auto& m = detail::unwrapped(f_);
    const auto& r = m(t, x);
    if (x_dot_.size() != x.size()) x_dot_ = x;
    const Eigen::Index rest = m.velocities_of(x).size() + m.internals_of(x).size();
    const S *q = x.data(), *v = r.data();
    for (const detail::freedom& f : m.freedoms()) detail::rate_of_one<S>(f, q, v, x_dot_);
    for (Eigen::Index i = 1; i <= rest; ++i) x_dot_[x.size() - i] = r[r.size() - i];
    return x_dot_;
  }
  /// The Jacobian of the model, if all its coordinates are numbers. Returns whether it is available.
  template <class J>
  bool jacobian(const S& t, const state& x, J& j) requires(std::is_same_v<J, typename model::jacobian_matrix>) {
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

 private:
  F f_;
  state x_dot_ = state::Zero(state::RowsAtCompileTime == Eigen::Dynamic ? 0 : state::RowsAtCompileTime);
};

}  // namespace kte
