#pragma once

#include <kte/integrators/motion_space.hpp>

#include <Eigen/Dense>
#include <boost/numeric/odeint/algebra/algebra_dispatcher.hpp>
#include <boost/numeric/odeint/external/eigen/eigen.hpp>  // Eigen vectors as states of odeint
#include <boost/numeric/odeint/util/state_wrapper.hpp>

#include <type_traits>
#include <utility>

/// The state that odeint keeps between steps. It copies steppers before their first step, so a fixed size starts with
/// zeros instead of uninitialized numbers.
template <class V>
struct boost::numeric::odeint::state_wrapper<
    V, std::enable_if_t<std::is_base_of_v<Eigen::PlainObjectBase<V>, V> && (V::SizeAtCompileTime > 0)>> {
  using state_wrapper_type = state_wrapper<V>;
  V m_v = V::Zero();
};

namespace kte {

/// Converts a right-hand side f(t, x) that returns x' to a system of odeint, which is called as system(x, x_dot, t):
///
///   namespace od = boost::numeric::odeint;
///   auto stepper = od::make_dense_output(1e-9, 1e-9, od::runge_kutta_dopri5<Eigen::Vector4d>());
///   od::integrate_const(stepper, kte::odeint_system(f), x, 0.0, 10.0, 0.01, observer);
///
/// States are Eigen column vectors of fixed or dynamic size. States with rotations are not supported, because odeint
/// adds states. An lvalue f is stored by reference and must outlive the system, because odeint copies systems at every
/// step; a temporary is stored by value.
template <class F>
class odeint_system {
 public:
  explicit odeint_system(F&& f) : f_(std::forward<F>(f)) { detail::refuse_moving_on_loops(f_, "steppers of odeint"); }

  template <class X, class S>
  void operator()(const X& x, X& x_dot, const S& t) {
    static_assert(!moves_on_group<detail::unwrapped_type<std::remove_reference_t<F>>, X>,
                  "kte: odeint adds states: for states with rotations use an integrator of kte");
    x_dot = f_(t, x);
  }

 private:
  F f_;
};

template <class F>
odeint_system(F&&) -> odeint_system<F>;

}  // namespace kte
