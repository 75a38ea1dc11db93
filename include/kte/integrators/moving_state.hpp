#pragma once

#include <kte/detail/no_value.hpp>
#include <kte/integrators/motion_space.hpp>
#include <kte/integrators/time_grid.hpp>

#include <array>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <utility>

namespace kte {

/// Counts of an integration so far.
struct step_statistics {
  long long steps = 0;           ///< accepted steps
  long long rejected = 0;        ///< rejected tries
  long long evaluations = 0;     ///< of the right-hand side, including those for differences
  long long jacobians = 0;       ///< of the right-hand side
  long long factorizations = 0;  ///< of matrices
};

namespace detail {
/// The right-hand side of a solver, for calls from outside.
struct right_hand_side {
  template <class Solver>
  static auto& of(const Solver& s) {
    return s.f_;
  }
};
}  // namespace detail

/// A right-hand side and the states of a step: from `x_`, at the start of the step, to `next_`, by displacements, which
/// are vectors even if states are not (motion_space.hpp). After the step, from `previous_` to `x_`. This is the part of
/// `integrator` that its methods use.
template <class F, class X>
class moving_state {
 public:
  using S = detail::time_scalar<typename X::Scalar>;  ///< of time, steps and errors
  using rate = rate_of<F, X>;
  static_assert(X::ColsAtCompileTime == 1, "kte: a state is a column vector");
  static_assert(!detail::has_states_on_group<detail::unwrapped_type<F>> || moves_on_group<detail::unwrapped_type<F>, X>,
                "kte: the states of this model move on a group: give the integrator a start state of its type `state`, "
                "as make_x does");

 protected:
  static constexpr bool is_called = std::invocable<F&, const S&, const X&>;
  /// Whether states are not vectors.
  static constexpr bool on_group = moves_on_group<detail::unwrapped_type<F>, X>;
  /// Whether states are kept on a manifold.
  static constexpr bool settles =
      detail::settles_states<detail::unwrapped_type<F>, X> || detail::settles_vectors<detail::unwrapped_type<F>, X>;
  template <class T>
  using if_on_group = std::conditional_t<on_group, T, detail::no_value>;

  explicit moving_state(F f) : f_(std::move(f)) {}
  const F& function() const { return f_; }
  /// Starts from x.
  void place(const X& x) {
    x_ = next_ = previous_ = x;
    if constexpr (on_group) d_ = within_ = sizes_[0] = sizes_[1] = no_rate();
  }

  /// The right-hand side.
  auto& system() { return detail::unwrapped(f_); }
  const auto& system() const { return detail::unwrapped(f_); }
  /// The number of rates.
  Eigen::Index rates() const {
    if constexpr (on_group) {
      return system().rates();
    } else {
      return x_.size();
    }
  }
  /// A rate of zeros.
  rate no_rate() const { return rate::Zero(rates()); }

  /// x_dot = f(t, x). Exceptions of f pass through.
  void evaluate(const S& t, const X& x, rate& x_dot) const {
    ++statistics_.evaluations;
    if constexpr (is_called) ask([&] { put(x_dot, [&]() -> decltype(auto) { return f_(t, x); }); });
    if (x_dot.size() != rates()) [[unlikely]]
      detail::raise<bad_argument>("kte: the right-hand side gave " + std::to_string(x_dot.size()) +
                                  " numbers for a state of " + std::to_string(x.size()));
  }
  /// next_ = state (+) d, with an expression d of rates.
  template <class D>
  void displace(const D& d) {
    if constexpr (on_group) {
      d_ = d;
      system().displace(x_, d_, next_);
    } else {
      next_ = x_ + d;
    }
    settled_ = false;
  }
  /// next_ = x, for states that are vectors.
  template <class V>
  void move_to(const V& x) {
    next_ = x;
    settled_ = false;
  }
  /// Projects `next_`, the end of the step, onto the constraints, with its displacement. Exceptions pass through
  /// `computes`.
  void settle_next() {
    if constexpr (settles) {
      if (settled_) return;
      ask([&] {
        if constexpr (on_group) {
          system().settle(x_, d_, next_);
        } else {
          system().settle(x_, next_);
        }
      });
      settled_ = true;
    }
  }
  /// Whether a next step may begin at `next_`. Exceptions pass through `computes`.
  void check_end() const {
    if constexpr (requires { system().check_end(x_, next_); }) ask([&] { system().check_end(x_, next_); });
  }
  /// The time of the next states that are put on the constraints, if these depend on it.
  void settle_at([[maybe_unused]] const S& t) const {
    if constexpr (settles)
      if constexpr (requires { system().settle_at(t); }) system().settle_at(t);
  }
  /// A step begins.
  void begin_at_state() const {
    if constexpr (settles) ask([&] { system().begin_step(x_); });
  }
  /// An error estimate of `next_` without its part normal to the constraints.
  template <class E>
  decltype(auto) tangential(E e) const {
    if constexpr (settles) {
      error_ = e;
      return tangential_in_place();
    } else {
      return e;
    }
  }
  const rate& tangential(const rate& e) const {
    if constexpr (settles) {
      error_ = e;
      return tangential_in_place();
    } else {
      return e;
    }
  }
  /// The rate of the displacement at its present value, with the state `next_`.
  void slope(const S& t, rate& k) {
    evaluate(t, next_, k);
    pull_back(k);
  }
  /// `evaluate` for trials: NaN if f cannot be computed.
  void evaluate_if_possible(const S& t, const X& x, rate& x_dot) const {
    if (!computes([&] { evaluate(t, x, x_dot); }, x))
      x_dot = rate::Constant(rates(), std::numeric_limits<S>::quiet_NaN());
  }
  /// Converts the rate of the state at `next_` to that of the displacement.
  void pull_back(rate& k) const {
    if constexpr (on_group) system().pull_back(d_, k);
  }
  /// x = state at the start of the last step (+) d.
  template <class D>
  void displaced(const D& d, X& x) const {
    displaced_freely(d, x);
    if constexpr (settles && on_group) {
      system().settle(previous_, within_, x);
    } else {
      settle_within(x);
    }
  }
  /// Projects a vector, a state within the last step, onto the constraints.
  void settle_within(X& x) const {
    if constexpr (settles && !on_group) system().settle(previous_, x);
  }
  /// The rate of the displacement d from the start of the last step, for a `dense` that needs evaluations. Overwrites
  /// `next_`.
  template <class D>
  void slope_within(const S& t, const D& d, rate& k) const {
    displaced_freely(d, next_);
    evaluate(t, next_, k);
    if constexpr (on_group) system().pull_back(within_, k);
  }
  /// The displacement of the last step; before `accept`, of the current step.
  decltype(auto) displacement() const {
    if constexpr (on_group) {
      return (d_);
    } else {
      return x_ - previous_;
    }
  }
  /// The displacement of the last call of `displaced`.
  const rate& displacement_within() const requires(on_group) { return within_; }
  /// The sizes to which relative tolerances refer, of `next_` and of another state at the same time.
  const rate& magnitudes(const X& x) const {
    if constexpr (on_group) {
      rate& m = sizes_[&x == &next_];
      system().magnitudes(x, m);
      return m;
    } else {
      return x;
    }
  }
  /// Whether `next_` has finite numbers only.
  bool next_is_finite() const { return detail::all_finite(next_); }

  /// Calls body(), which is user code, and marks its exceptions, so that they can be distinguished from those of kte.
  template <class Body>
  void ask(const Body& body) const {
    is_asking_ = true;
    body();
    is_asking_ = false;
  }
  /// Calls body(), which evaluates f. Returns false if f throws `bad_argument` or `singular_mass_matrix`, which a
  /// shorter step may avoid. The message is kept as the reason if the state x is finite.
  template <class Body>
  bool computes(const Body& body, const X& x) const {
    return computed([&] { return body(), true; }, false, x);
  }
  /// The result of a function; `otherwise` if it fails.
  template <class Body, class T>
  T computed(const Body& body, [[maybe_unused]] const T& otherwise, [[maybe_unused]] const X& x) const {
#if defined(__cpp_exceptions)
    is_asking_ = false;
    try {
      return body();
    } catch (const bad_argument& e) {
      if (!is_asking_) throw;
      keep_reason(e, x);
    } catch (const singular_mass_matrix& e) {
      if (!is_asking_) throw;
      keep_reason(e, x);
    }
    return otherwise;
#else
    return body();
#endif
  }
  void forget_reason() { reason_.clear(); }
  /// The reason to add to a message about numbers that are not finite; may be empty.
  const std::string& cause() const { return reason_; }
  std::string reason() const { return reason_.empty() ? std::string() : ": " + reason_; }

  X x_, previous_;
  mutable X next_;
  mutable step_statistics statistics_;

 private:
  const rate& tangential_in_place() const requires(settles) {
    ask([&] { system().tangential(x_, error_); });
    return error_;
  }
  template <class D>
  void displaced_freely(const D& d, X& x) const {
    if constexpr (on_group) {
      within_ = d;
      system().displace(previous_, within_, x);
    } else {
      x = previous_ + d;
    }
  }
  /// out = value(), constructed in place if it has this type.
  template <class Value>
  static void put(rate& out, const Value& value) {
    if constexpr (std::is_same_v<decltype(value()), rate> && std::is_trivially_destructible_v<rate>) {
      ::new (static_cast<void*>(&out)) rate(value());
    } else {
      out = value();
    }
  }
  [[gnu::cold, gnu::noinline]] void keep_reason(const error& e, const X& x) const {
    is_asking_ = false;
    const std::string_view text = e.what(), name = "kte: ";
    if (detail::all_finite(x)) reason_ = text.substr(text.starts_with(name) ? name.size() : 0);
  }

  friend detail::right_hand_side;
  mutable std::remove_const_t<F> f_;
  mutable bool is_asking_ = false;
  mutable std::string reason_;                 ///< why f could not be computed in this step
  [[no_unique_address]] if_on_group<rate> d_;  ///< from x_ to next_
  [[no_unique_address]] mutable if_on_group<rate> within_;
  [[no_unique_address]] mutable std::conditional_t<settles, rate, detail::no_value> error_;
  bool settled_ = false;
  [[no_unique_address]] mutable if_on_group<std::array<rate, 2>> sizes_;
};

}  // namespace kte
