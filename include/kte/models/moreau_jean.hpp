#pragma once

#include <kte/integrators/fixed_step.hpp>
#include <kte/models/controlled.hpp>
#include <kte/models/detail/contact_stepper.hpp>
#include <kte/models/detail/law_slopes.hpp>

namespace kte {

/// Settings of `moreau_jean`.
struct time_stepping_options {
  /// The depth up to which a start inside a surface is accepted, relative to the length of the chain. To go on from the
  /// state of a step, which may be deeper, set it.
  double depth = 1e-8;
  /// Whether the law of `controlled` may be stiff, as long as it acts on coordinates: a step then evaluates it at its
  /// middle, again where a contact strikes, and twice for each coordinate. Otherwise it is evaluated once a step, at
  /// its begin, and the inputs are constant within the step.
  bool implicit_control = false;
};

/// Time stepping of models with rigid contacts, after Moreau and Jean, order 1, with a fixed step h:
///
///   q_m = q (+) h/2 v,   z_m = z + h/2 z'                                                        (1)
///   M~ (v^+ - v) = h (f(t + h/2, q_m, v_m, z_m) + D (v_m - v)) + J^T P,   M~ = M + h D + h^2/2 K  (2)
///   q^+ = q_m (+) h/2 v^+,   z^+ = z_m + h/2 z'                                                   (3)
///
/// with v_m = v + (v - v^-)/2 from the last step, or if there is none or a contact strikes, with v_m = v + (v^+ - v)/2
/// from a solution for another v_m; P of contacts with gaps g(q_m) <= 0, up to 1e-9 of the length of the chain. P
/// satisfies Coulomb's law exactly at the velocity level: cones are not linearised
/// (dynamics/contacts/velocity_step.hpp). Nothing locates the time of an impact, so that any number of contacts may
/// open and close in a step. A penetration of the size h |v| at an impact remains: correcting it would change
/// velocities.
///
/// D = -df/dv and K = -df/dq are those of springs, dampers, motors and other elements between coordinates, and with
/// `implicit_control` of the law of `controlled` on coordinates, so that they may be stiff; those of a law are
/// differences. Forces between frames are explicit, as is a law without this option. Internal states z are linearly
/// implicit. Dense output: linear.
///
/// Moreau, Numerical aspects of the sweeping process, Computer Methods in Applied Mechanics and Engineering 177 (1999);
/// Jean, The non-smooth contact dynamics method, same volume.
///
///   moreau_jean solver(std::cref(model), 0.0, x0, 1e-3);
///   solver.integrate(2.0, every(0.01), [&](double t, const auto& x) { recorder.row(t, solver.state_at(t, x)); });
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
  /// that is not positive, a start that is not finite, and a start inside a surface, with the name of the contact.
  moreau_jean(F f, const S& t0, const std::type_identity_t<X>& x0, const S& step,
              const time_stepping_options& options = {})
      : base(std::move(f), t0, stepped(f, x0), step),
        stepper_(detail::model_in(this->system())),
        d_(this->no_rate()),
        implicit_control_(options.implicit_control) {
    stepper_.check_depth(detail::model_in(this->system()), t0, detail::state_of_model(this->system(), x0),
                         options.depth);
    internals_.resize(d_.size() - 2 * detail::model_in(this->system()).velocity_count());
  }
  /// A contact in the last step, by name or key: gap, slip and mode at its middle, and the mean force, N.
  template <class Name>
  [[nodiscard]] const contact_state<>& contact(const Name& name) const {
    return stepper_.contact(name);
  }
  /// A state of the chain at t and x, for recorders: with all its frames, and the accelerations and contact forces of
  /// the last step, which are means, and the inputs of the law at x or, unless it is implicit, those of the last step.
  /// Of runtime chains valid until the next call.
  decltype(auto) state_at(const S& t, const X& x) {
    auto& f = this->system();
    const auto& model = detail::model_in(f);
    if (implicit_control_ || last_h_ == 0) set_inputs(t, x);
    mean_.setZero(model.velocity_count());
    if (last_h_ > 0) mean_ = change_ / last_h_;
    return stepper_.state_at(model, t, detail::state_of_model(f, x), mean_);
  }

 private:
  void try_step(const S& end) {
    const S h = end - this->time_;
    if (!(h > 0)) this->fail("impacts cannot be integrated backwards", failure_reason::no_convergence);
    auto& f = this->system();
    const auto& model = detail::model_in(f);
    const Eigen::Index n = model.velocity_count(), z = internals_.size();
    mark(f, this->x_);
    const auto v = f.velocities_of(this->x_);
    if (!implicit_control_) this->ask([&] { set_inputs(this->time_, this->x_); });
    d_.head(n) = (h / 2) * v, d_.segment(n, n).setZero();
    internals_.setZero();
    put_internals(this->time_, this->x_, h / 2), d_.tail(z) = internals_;
    this->displace(d_);  // (1)
    auto& x = this->next_;
    const auto velocities = [&] { return x.segment(x.size() - n - z, n); };
    const bool follows = last_h_ > 0 && after_ == v;
    if (follows) velocities() += (h / (2 * last_h_)) * change_;
    const S middle = this->time_ + h / 2;
    const auto evaluate = [&](const auto& step) {
      ++this->statistics_.evaluations;
      after_ = v;
      this->ask([&] { step(detail::state_of_model(f, x)); });
    };
    set_inputs_within(middle, x);
    const detail::force_slopes* law = nullptr;
    if constexpr (detail::has_law<detail::unwrapped_type<F>, X>)
      if (implicit_control_) law = slopes_.find(f, stepper_, middle, x);
    evaluate([&](const auto& at) { stepper_.first(model, middle, at, h, law, after_); });  // (2)
    if (!follows || stepper_.strikes(model)) {
      velocities() = (v + after_) / 2;
      set_inputs_within(middle, x);
      evaluate([&](const auto& at) { stepper_.again(model, middle, at, h, after_); });
    }
    velocities() = after_, put_internals(middle, x, h / 2), d_.tail(z) += internals_;
    change_ = after_ - v, last_h_ = h;
    d_.head(n) = (h / 2) * (v + after_), d_.segment(n, n) = change_;
    this->displace_at_last(d_);  // (3)
    after_ = f.velocities_of(x);
  }
  /// Marks the contacts in x as those of time stepping.
  template <class System>
  static void mark(const System& f, X& x) {
    detail::model_in(f).each_contact([&x](int, int first) { x[first] = detail::stepped_mode; });
  }
  static X stepped(const F& f, X x) {
    mark(detail::unwrapped(f), x);
    return x;
  }
  void set_inputs(const S& t, const X& x) {
    if constexpr (detail::has_law<detail::unwrapped_type<F>, X>) this->system().set_inputs(t, x);
  }
  /// Within a step, where an implicit law is evaluated.
  void set_inputs_within(const S& t, const X& x) {
    if (implicit_control_) this->ask([&] { set_inputs(t, x); });
  }
  /// h z' / (1 - h dz'/dz) at x, with the diagonal of dz'/dz where it is negative, by differences.
  void put_internals(const S& t, const X& x, const S& h) {
    auto& f = this->system();
    const auto& model = detail::model_in(f);
    const Eigen::Index all = model.internals(), n = all - detail::numbers_of_contact * model.contacts();
    const Eigen::Index laws = internals_.size() - all;
    if (n + laws == 0) return;
    set_inputs_within(t, x);
    const auto rates = [&](const auto& at, auto& to) { stepper_.internal_rates(model, t, at, to.data()); };
    if (n > 0) {
      varied_ = detail::state_of_model(f, x), z_dot_.resize(n), varied_dot_.resize(n);
      rates(varied_, z_dot_);
      for (Eigen::Index i = 0; i < n; ++i) {
        double& z = varied_[varied_.size() - all + i];
        const double there = z, by = 1e-8 + 1e-6 * std::abs(z);
        z += by, rates(varied_, varied_dot_), z = there;
        internals_[i] = h * z_dot_[i] / (1 + h * (std::max)(0.0, (z_dot_[i] - varied_dot_[i]) / by));
      }
    }
    if constexpr (requires { f.put_law_rates(t, x, internals_.tail(laws)); }) {
      f.put_law_rates(t, x, internals_.tail(laws));
      internals_.tail(laws) *= h;
    }
  }
  static constexpr int degree() { return 1; }
  void dense(const S& theta, X& x) const { this->displaced(theta * d_, x); }

  detail::contact_stepper<model_type> stepper_;
  detail::law_slopes<X> slopes_;
  rate d_;
  bool implicit_control_;
  Eigen::VectorXd after_, change_;  ///< v^+, and v^+ - v of the last step
  S last_h_{};                      ///< of the last step, or 0
  Eigen::VectorXd mean_;            ///< accelerations
  Eigen::VectorXd internals_, z_dot_, varied_dot_;
  typename model_type::state varied_;
};
template <class F, class V>
moreau_jean(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> moreau_jean<F, typename V::PlainObject>;
template <class F, class V>
moreau_jean(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&,
            const time_stepping_options&) -> moreau_jean<F, typename V::PlainObject>;

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/models/detail/contact_bridge.hpp>
#endif
