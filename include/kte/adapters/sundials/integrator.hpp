#pragma once

#include <kte/adapters/sundials/counts.hpp>
#include <kte/adapters/sundials/handles.hpp>
#include <kte/adapters/sundials/relay.hpp>
#include <kte/integrators/integrator.hpp>
#include <kte/integrators/tolerances.hpp>

#include <algorithm>
#include <cstdlib>
#include <limits>

/// Integrators of SUNDIALS with the interface of kte's integrators: Hindmarsh et al., SUNDIALS: Suite of nonlinear and
/// differential/algebraic equation solvers, ACM Trans. Math. Softw. 31 (2005), 363-396.
namespace kte::sundials {

/// Base of the integrators of SUNDIALS. It can be neither copied nor moved: SUNDIALS keeps its address.
///
/// The norm of the error e of a step from x is that of SUNDIALS:
///
///   |e| = sqrt(1/n sum_i (w_i e_i)^2),   w_i = 1 / (absolute_i + relative_i |x_i|)          (1)
///
/// `integrate` continues with the step and order of the previous call, unless time turns back. The error control
/// detects a jump of f; after a jump of the state call `restart`. Exceptions of f leave `integrate`.
///
/// A solver derives from this class with itself as `Method` and has functions that return a flag of SUNDIALS:
///
///   initialize()                starts again from `time_` and `y_`
///   begin_with(h)               sets the length h of the next step
///   take_step(t_end, reached)   one step towards t_end, not beyond: stores the state in `y_` and its time in `reached`
///   dense_at(t, y)              the state y at a time of the last step
///
/// and `counted()`, the counts since `initialize`, and `flag_name(flag)`, a text allocated by malloc.
template <class Method, class F, class X>
class integrator : public kte::integrator<Method, F, X> {
  using base = kte::integrator<Method, F, X>;
  friend base;
  static_assert(std::is_same_v<typename X::Scalar, double> && std::is_same_v<realtype, double>,
                "kte: SUNDIALS computes in double here: the state must be a vector of double");
  static_assert(!base::on_group, "kte: SUNDIALS adds states: for states with rotations use an integrator of kte");

 public:
  using typename base::S;

  integrator(const integrator&) = delete;
  integrator& operator=(const integrator&) = delete;

  /// Continues from another time and state, for instance after an impact. Throws `bad_argument` unless they are finite,
  /// and for a state of wrong size.
  template <class V>
  void restart(const S& t, const Eigen::MatrixBase<V>& x) {
    if (x.size() != this->x_.size())
      kte::detail::raise<bad_argument>("kte: restart with " + std::to_string(x.size()) + " numbers of a state of " +
                                       std::to_string(this->x_.size()));
    base::restart(t, x);
    fresh_ = true;
  }

 protected:
  template <class V>
  integrator(F f, const S& t0, const Eigen::MatrixBase<V>& x0, const tolerances<S>& tol)
      : base(std::move(f), t0, x0), y_(vector_of(this->x_)), tolerances_(tol) {
    tol.check(this->x_.size());
    kte::detail::refuse_moving_on_loops(this->function(), "solvers of SUNDIALS");
  }
  ~integrator() = default;

  /// A SUNDIALS vector that refers to the numbers of x.
  detail::vector_handle vector_of(X& x) const {
    return detail::vector_handle(detail::made(N_VMake_Serial(x.size(), x.data(), context_.get())));
  }
  /// (1), as a callback of SUNDIALS.
  static int weights(N_Vector y, N_Vector w, void* self) {
    const integrator& me = *static_cast<Method*>(self);
    const tolerances<S>& tol = me.tolerances_;
    const auto x = detail::numbers<X>(y);
    auto out = detail::numbers<X>(w);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const S size = tol.absolute[i] + tol.relative[i] * std::abs(x[i]);
      if (!(size > 0)) return -1;  // SUNDIALS does not accept an error of 0
      out[i] = 1 / size;
    }
    return 0;
  }
  /// The return value of a user function for SUNDIALS: a number that is not finite may be avoided by a shorter step.
  template <class M>
  int judged(const M& result) {
    if (kte::detail::all_finite(result)) return 0;
    return refused();
  }
  int refused() {
    finite_ = false;
    return 1;
  }
  /// Throws `bad_argument` for a setting that SUNDIALS rejects.
  void require(int flag) const {
    if (flag < 0) kte::detail::raise<bad_argument>("kte: " + reason_of(flag));
  }
  /// Throws the exception of a user function, or `integration_failure` for a flag of failure.
  void check(int flag) const {
    relay_.rethrow();
    if (flag < 0)
      this->fail((finite_ ? "" : std::string(non_finite) + this->base::reason() + "; ") + reason_of(flag),
                 failure_reason::other);
  }

  /// Passes the present time and state to SUNDIALS.
  void restart_solver() {
    N_VSetArrayPointer(this->x_.data(), y_.get());
    accountant_.restart();
    prepare();
    check(method().initialize());
    if (tolerances_.initial_step != S(0)) require(method().begin_with(tolerances_.initial_step));
  }
  /// Updates the statistics; called after all expensive calls.
  void count() { tries_ += 1 + accountant_.add(method().counted(), this->statistics_); }

  detail::context_handle context_ = detail::make_context();
  detail::vector_handle y_;
  mutable detail::relay relay_;  ///< also used by interpolation, which may call f
  bool backward_ = false;        ///< whether time runs backward

 private:
  void start(const S& t_end) {
    tries_ = 0;
    if ((t_end < this->time_) == backward_) return;
    backward_ = !backward_;
    fresh_ = true;
    this->previous_time_ = this->time_;  // the last step is invalid
  }
  void advance(const S& t_end) {
    this->previous_time_ = this->time_;  // the last step is invalid
    if (fresh_ && is_lost(t_end)) return skip_to(t_end);
    if (fresh_) restart_solver();
    if (tries_ >= tolerances_.max_steps) [[unlikely]]
      this->fail("max_steps = " + std::to_string(tolerances_.max_steps) + " steps are used up",
                 failure_reason::too_many_steps);
    fresh_ = true;  // until the step succeeds; after a failure the memory of SUNDIALS is not used
    prepare();
    S reached = this->time_;
    N_VSetArrayPointer(this->next_.data(), y_.get());
    const int flag = method().take_step(t_end, reached);
    count();
    check(flag);
    if (!this->next_is_finite()) [[unlikely]]
      this->fail("the next state is not a finite number", failure_reason::not_finite);
    if (reached != t_end && is_lost(reached)) [[unlikely]]
      this->fail(finite_ ? "the tolerances need steps that are lost in the rounding of t" : non_finite,
                 finite_ ? failure_reason::step_too_short : failure_reason::not_finite);
    this->accept(reached);
    fresh_ = false;
  }
  static constexpr int degree() { return 12; }  // of the highest order
  void dense(const S& theta, X& x) const {
    N_VSetArrayPointer(x.data(), y_.get());
    check(method().dense_at(this->previous_time_ + theta * (this->time_ - this->previous_time_), y_.get()));
  }

  void prepare() {
    finite_ = true;
    relay_.clear_message();
  }
  /// Whether t is within a few ulp of the present time.
  bool is_lost(const S& t) const {
    using std::abs;
    return abs(t - this->time_) <= 4 * std::numeric_limits<S>::epsilon() * (std::max)(abs(this->time_), abs(t));
  }
  /// For an end so close that SUNDIALS does not start. The state changes by less than the rounding of t.
  void skip_to(const S& t_end) {
    this->next_ = this->x_;
    this->accept(t_end);
    this->previous_time_ = t_end;
  }
  std::string reason_of(int flag) const {
    const std::unique_ptr<char, detail::freed_by<std::free>> name(Method::flag_name(flag));
    return name.get() + (relay_.message().empty() ? "" : ": " + relay_.message());
  }
  Method& method() { return static_cast<Method&>(*this); }
  const Method& method() const { return static_cast<const Method&>(*this); }

  static constexpr const char* non_finite = "f is not finite, however short the step";
  tolerances<S> tolerances_;
  detail::accountant accountant_;
  long long tries_ = 0;
  bool fresh_ = true;   ///< whether SUNDIALS must be initialized with the present state
  bool finite_ = true;  ///< whether all results of user functions in this step were finite
};

}  // namespace kte::sundials
