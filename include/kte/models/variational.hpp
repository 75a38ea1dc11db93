#pragma once

#include <kte/integrators/detail/hermite.hpp>
#include <kte/integrators/detail/secant_iteration.hpp>
#include <kte/integrators/fixed_step.hpp>
#include <kte/models/detail/momenta.hpp>
#include <kte/models/detail/momentum_transport.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

#include <array>

namespace kte {

/// A variational integrator of a mechanism, of order 2 or 4, with a fixed step h. It makes the sum over the steps of
///
///   h L(q_m, v)   with the middle q_m of a step and its velocity v       (1)
///
/// stationary, with the kinetic minus the potential energy L of the chain. It is therefore symplectic: energy
/// oscillates and does not drift. It conserves the momenta of symmetries to rounding, such as the linear and angular
/// momentum of a floating mechanism. For coordinates that are numbers it is the midpoint rule in momenta:
///
///   p = M(q_m) v,   p0, p1 = p -+ h/2 p',   p' = M_dot v + f(q_m, v)        (2)
///   q_m = q0 + h/2 v,   q1 = q0 + h v                                       (3)
///
/// with f of `forces_at`: dampers and motors act by their force at the midpoint. For rotations see
/// models/detail/momentum_transport.hpp. The equations are solved to rounding by iteration, for which h must be below
/// about 1 over the fastest rate. The iteration starts with v extrapolated from the last steps, and with M as a matrix
/// that is updated from the changes (`secant_iteration`). Order 4: five steps of (1), of lengths
///
///   g h, g h, (1 - 4 g) h, g h, g h,   g = 1/(4 - 4^(1/3))                  (4)
///
/// Dense output: cubics by the velocities at both step ends, of order 3. The model may belong to a static chain or,
/// with kte/models/runtime_dynamics_model.hpp, to a runtime chain, which allocates in every step. Chains with internal
/// states are refused:
///
///   kte::variational4 solver(std::ref(model), 0.0, model.make_x(q, v), 0.01);
///
/// Marsden and West, Discrete mechanics and variational integrators, Acta Numerica 10 (2001), 2.3; (4): Suzuki, Phys.
/// Lett. A 146 (1990).
template <int Order, class F, class X>
class variational : public fixed_step<variational<Order, F, X>, F, X> {
  using base = fixed_step<variational, F, X>;
  friend base;
  friend typename base::integrator;
  using model = detail::unwrapped_type<F>;
  static_assert(Order == 2 || Order == 4, "kte: variational integrators are of order 2 or 4");

 public:
  using typename base::rate;
  using typename base::S;
  static constexpr int order = Order, dense_order = 3;  ///< of the method and of its dense output

  /// A model, start time, s, start state, step, s. Throws `bad_argument` for a step that is not positive, for a start
  /// that is not finite, and for a runtime chain with internal states or closed loops.
  variational(F f, const S& t0, const std::type_identity_t<X>& x0, const S& step)
      : base(std::move(f), t0, x0, step), middle_(this->x_), masses_(chain()) {}

 private:
  using chain_type = std::remove_cvref_t<decltype(std::declval<const model&>().chain())>;
  static constexpr int n = detail::sizes_of_model<chain_type>::v;
  using vector = joint_vector<S, n>;

  /// The velocities of a state.
  template <class State>
  auto velocities_in(State& x) const {
    return x.tail(Eigen::fix<n>(this->system().velocity_count()));
  }
  void prepare() {
    v_ = velocities_in(this->x_);
    this->ask([&] { p_ = masses_.at(chain(), this->x_.data(), v_); });
    lost_q_.setZero(v_.size()), lost_p_.setZero(v_.size());
    known_ = 0;
  }
  void try_step(const S& end) {
    this->ask([&] { advance_to(end); });
  }
  void advance_to(const S& end) {
    const S h = end - this->time_;
    this->next_ = this->x_;
    if (known_ != 0 && !same_length(h)) known_ = 0;
    length_ = h;
    if constexpr (Order == 2) {
      advance_by(h, 0);
    } else {
      using std::cbrt;
      const S g = 1 / (4 - cbrt(S(4)));
      int part = 0;
      for (const S& share : {g, g, S(1 - 4 * g), g, g}) advance_by(share * h, part++);  // (4)
    }
    if (known_ < remembered) ++known_;
    vector v = p_;
    masses_.solve(chain(), this->next_.data(), v);
    velocities_in(this->next_) = v;
  }
  bool same_length(const S& h) const {
    using std::abs;
    return abs(S(h - length_)) < S(1e-6) * abs(h);
  }
  /// Predicts v of a substep from the same substep of the last steps: the polynomial through them, at one h later.
  void guess(int part) {
    const auto& p = past_[static_cast<std::size_t>(part)];
    if (known_ == 2) v_ = 2 * p[0] - p[1];
    if (known_ == 3) v_ = 3 * (p[0] - p[1]) + p[2];
    if (known_ == 4) v_ = 4 * (p[0] + p[2]) - 6 * p[1] - p[3];
  }
  /// One step of (1), a substep of the whole: updates q in `next_`, and p_.
  void advance_by(const S& h, int part) {
    const X start = this->next_;
    vector d = lost_q_, half = d, change = d;
    const vector last = v_;
    auto& secants = secants_[Order == 4 && part == 2 ? 1 : 0];
    const auto improve = [&] {
      for_each([&](const auto& f) { detail::momentum_step<S>(f, h, v_).displacement(d); });
      half = d / 2;
      displace(start, half, middle_);
      velocities_in(middle_) = v_;
      const auto both = masses_.along(chain(), middle_.data(), v_);
      const vector& p = both.first;
      vector rate_of_p = both.second;
      rate_of_p += this->system().forces_at(middle_, this->time() + h / 2);
      ++this->statistics_.evaluations;
      vector v = p_;
      for_each([&](const auto& f) {
        const detail::momentum_step<S> step(f, h, v_);
        step.subtract_turning(p, rate_of_p);
        step.to_middle(rate_of_p, v);
        step.change(rate_of_p, p_, change);
      });
      v -= p;
      masses_.solve(chain(), middle_.data(), v);
      const S size = v_.norm();
      secants.improve(v, size);
      const S by = v.norm();
      v_ += v;
      return size == S(0) ? by : S(by / size);
    };
    guess(part), secants.begin(known_ == 0);
    if (detail::iterate<S>(improve) != detail::iteration::converged) {
      v_ = last, secants.begin_plainly();
      this->iterate(h, improve);
    }
    auto& past = past_[static_cast<std::size_t>(part)];
    for (std::size_t i = remembered - 1; i > 0; --i) past[i] = past[i - 1];
    past[0] = v_;
    for_each([&](const auto& f) { detail::momentum_step<S>(f, h, v_).displacement(d); });
    d += lost_q_, change += lost_p_;
    displace(start, d, this->next_);
    for_each([&](const auto& f) {
      if (f.what == kind::gen) lost_q_[f.v] = d[f.v] - (this->next_[f.q] - start[f.q]);
    });
    const vector p = p_;
    p_ += change;
    lost_p_ = change - (p_ - p);
  }

  /// With rotations, rates are not polynomials, but a polynomial of this degree agrees with a step to rounding.
  static constexpr int degree() { return base::on_group ? 9 : 3; }
  void dense(const S& theta, X& x) const {
    const S h = this->time_ - this->previous_time_;
    vector v1 = velocities_in(this->x_), d = v1;
    const vector v0 = velocities_in(this->previous_);
    const S *from = this->previous_.data(), *to = this->x_.data();
    for_each([&](const auto& f) { detail::displacement_between<S>(f, from, to, d); });
    for_each([&](const auto& f) { detail::pull_back_one<S>(f, d, v1); });
    const vector at = detail::hermite_cubic(theta, h, d, v0, v1);
    vector v = detail::hermite_slope(theta, h, d, v0, v1);
    for_each([&](const auto& f) { detail::push_forward_one<S>(f, at, v); });
    rate d_of_both(2 * v.size());
    d_of_both << at, v - v0;
    this->displaced(d_of_both, x);
  }

  const auto& chain() const { return this->system().chain(); }
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const detail::freedom& f : this->system().freedoms()) visit(f);
  }
  void displace(const X& from, const vector& d, X& to) const {
    for_each([&](const auto& f) { detail::displace_one<S>(f, from, d, to); });
  }

  static constexpr int remembered = 4, parts = Order == 2 ? 1 : 5;
  X middle_;
  detail::momenta_of<chain_type, S> masses_;
  vector p_, v_;  ///< momenta at the present q; velocities of the last substep, as a guess for the next
  std::array<std::array<vector, remembered>, parts>
      past_;       ///< velocities of each substep in the last steps, newest first
  int known_ = 0;  ///< number of known entries of past_
  S length_{0};    ///< of the last step
  std::array<detail::secant_iteration<S, n>, Order == 2 ? 1 : 2> secants_;  ///< one per length of substeps
  vector lost_q_, lost_p_;                                                  ///< rounding errors, as in `fixed_step`
};

/// The variational integrator of order 2.
template <class F, class X>
class variational2 : public variational<2, F, X> {
 public:
  using variational<2, F, X>::variational;
};
template <class F, class V>
variational2(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> variational2<F, typename V::PlainObject>;
/// The variational integrator of order 4.
template <class F, class X>
class variational4 : public variational<4, F, X> {
 public:
  using variational<4, F, X>::variational;
};
template <class F, class V>
variational4(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const typename V::Scalar&)
    -> variational4<F, typename V::PlainObject>;

}  // namespace kte
