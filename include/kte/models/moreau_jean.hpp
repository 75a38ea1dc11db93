#pragma once

#include <kte/integrators/fixed_step.hpp>
#include <kte/models/controlled.hpp>
#include <kte/models/detail/contact_stepper.hpp>

namespace kte {

namespace detail {
/// A model under a control law, or a model.
template <class F>
decltype(auto) model_in(const F& f) {
  if constexpr (requires { f.model(); })
    return f.model();
  else
    return (f);
}
}  // namespace detail

/// Time stepping of models with rigid contacts, after Moreau and Jean, order 1, with a fixed step h:
///
///   q_m = q (+) h/2 v                                                                          (1)
///   v^+ = v + h a_0(t + h/2, q_m, v_m) + M^-1 J^T P,   P of contacts with gaps g(q_m) <= 0      (2)
///   q^+ = q (+) h/2 (v + v^+)                                                                  (3)
///
/// with v_m = v, then again with v_m = (v + v^+)/2. P satisfies Coulomb's law exactly at the velocity level: cones are
/// not linearised (dynamics/contacts/ velocity_step.hpp). Nothing locates the time of an impact, so that any number of
/// contacts may open and close in a step. A penetration of the size h |v| at an impact remains: correcting it would
/// change velocities. Elements are explicit: stiff springs, dampers and controllers need a small h. Models with
/// internal states are refused. Dense output: linear.
///
/// Moreau, Numerical aspects of the sweeping process, Computer Methods in Applied Mechanics and Engineering 177 (1999);
/// Jean, The non-smooth contact dynamics method, same volume.
///
///   moreau_jean solver(std::cref(model), 0.0, x0, 1e-3);
///   solver.integrate(2.0, every(0.01), recorder);
///   solver.contact("foot").force
template <class F, class X>
class moreau_jean : public fixed_step<moreau_jean<F, X>, F, X> {
  using base = fixed_step<moreau_jean, F, X>;
  friend base;
  friend typename base::integrator;
  using model_type = std::remove_cvref_t<decltype(detail::model_in(std::declval<const detail::unwrapped_type<F>&>()))>;

 public:
  using typename base::rate;
  using typename base::S;
  static_assert(std::is_same_v<S, double>, "kte: contacts are computed in double");
  static constexpr int order = 1, dense_order = 1;  ///< of the method and of its dense output

  /// A model, or a model under a control law; start time, s, start state, step, s. Throws `bad_argument` for a step
  /// that is not positive, a start that is not finite, and a model with internal states.
  moreau_jean(F f, const S& t0, const std::type_identity_t<X>& x0, const S& step)
      : base(std::move(f), t0, x0, step), stepper_(detail::model_in(this->system())), d_(this->no_rate()) {
    if (this->system().internals() > 0)
      throw bad_argument("kte: moreau_jean does not support models with internal states");
  }
  /// A contact in the last step, by name or key: gap, slip and mode at its middle, and the mean force, N.
  template <class Name>
  [[nodiscard]] const contact_state<>& contact(const Name& name) const {
    return stepper_.contact(name);
  }

 private:
  void try_step(const S& end) {
    const S h = end - this->time_;
    auto& f = this->system();
    const auto n = static_cast<Eigen::Index>(f.velocity_count());
    const auto v = f.velocities_of(this->x_);
    d_.head(n) = (h / 2) * v, d_.tail(n).setZero();
    this->displace(d_);  // (1)
    const S middle = this->time_ + h / 2;
    for (int i = 0; i < 2; ++i) {  // (2)
      if (i > 0) this->next_.tail(n) = (v + after_) / 2;
      if constexpr (requires { f.set_inputs(middle, this->next_); }) f.set_inputs(middle, this->next_);
      ++this->statistics_.evaluations;
      after_ = v;
      stepper_.step(detail::model_in(f), middle, this->next_, h, after_);
    }
    d_.head(n) = (h / 2) * (v + after_), d_.tail(n) = after_ - v;
    this->displace_at_last(d_);  // (3)
  }
  static constexpr int degree() { return 1; }
  void dense(const S& theta, X& x) const { this->displaced(theta * d_, x); }

  detail::contact_stepper<model_type> stepper_;
  rate d_;
  Eigen::VectorXd after_;  ///< v^+
};
template <class F, class V>
moreau_jean(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> moreau_jean<F, typename V::PlainObject>;

}  // namespace kte
