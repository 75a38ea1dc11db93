#pragma once

#include <kte/detail/no_value.hpp>
#include <kte/integrators/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace kte {

/// A solution as a function of time, made of the dense output of every step, for every solver, forward or backward,
/// also with events:
///
///   kte::solution x(solver);
///   solver.integrate(10.0, x);
///   const auto there = x(3.7);
///
/// It is as accurate as the dense output of the solver, up to rounding. For each step it stores the start and the
/// displacements d from it at m times, m the degree of the polynomial of the solver:
///
///   d(theta) = sum_j w_j d_j / (theta - theta_j) / sum_j w_j / (theta - theta_j)                  (1)
///   theta_j = (1 - cos(pi j / m)) / 2,   w_j = (-1)^j, half of that for j = 0, m                  (2)
///
/// m is 1 to 7 for one-step methods (4 for `dormand_prince45`; 7 for `prince_dormand87`, with four additional
/// evaluations a step), the order for `bdf`, the order + 1 for `adams`, but at least 3. Memory for states of n numbers
/// with r rates: 4 + n + m r numbers a step, on the heap. A look-up takes the logarithm of the number of steps.
///
/// Further calls of `integrate` extend the solution. Berrut and Trefethen, Barycentric Lagrange Interpolation, SIAM
/// Review 46 (2004), (4.2), (5.4). The integrator calls `before`, `after` and `settle`.
template <class F, class X>
class solution {
  using system = detail::unwrapped_type<F>;
  static constexpr bool on_group = moves_on_group<system, X>;
  static constexpr bool uses_system = on_group || detail::settles_vectors<system, X>;

 public:
  using S = detail::time_scalar<typename X::Scalar>;
  using rate = rate_of<F, X>;
  using follows_steps = void;

  /// The solution of a solver, from its present time on.
  template <class Method>
  explicit solution(const integrator<Method, F, X>& solver)
      : motion_(motion_of(solver)),
        begin_(solver.time()),
        end_(begin_),
        last_(solver.state()),
        from_(last_),
        d_(solver.displacement_to(S(0))) {}

  /// The first time, s.
  [[nodiscard]] const S& begin() const { return begin_; }
  /// The last time, s.
  [[nodiscard]] const S& end() const { return end_; }
  [[nodiscard]] std::size_t steps() const { return pieces_.size(); }

  /// The state at a time, s; at a reset the state after it. Throws `bad_argument` for a time out of range.
  X operator()(const S& t) const {
    X x = last_;
    at(t, x);
    return x;
  }
  /// Writes the state at a time into x, without allocation.
  void at(const S& t, X& x) const {
    if (!(is_forward() ? begin_ <= t && t <= end_ : end_ <= t && t <= begin_)) [[unlikely]]
      detail::raise<bad_argument>("kte: this solution goes from t = " + detail::number(detail::as_double(begin_)) +
                                  " to " + detail::number(detail::as_double(end_)) + ", not to " +
                                  detail::number(detail::as_double(t)));
    if (t == end_) return void(x = last_);
    const bool forward = is_forward();
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), t, [&](const S& now, const piece& p) {
      return forward ? now < p.begin : p.begin < now;
    });
    evaluate_piece(*(after - 1), t, x);
  }

  // ---- receiver of an integration (integrators/detail/followers.hpp)
  template <class Solver>
  bool start(const Solver& solver) {
    if (solver.time() != end_)
      detail::raise<bad_argument>("kte: this solution continues at t = " + detail::number(detail::as_double(end_)) +
                                  ", its end, not at " + detail::number(detail::as_double(solver.time())));
    last_ = solver.state();
    return true;
  }
  template <class Solver>
  bool step(const Solver& solver) {
    append(solver, solver.time(), solver.state());
    return true;
  }
  template <class Solver>
  bool before(const Solver& solver, const S& t, const X& x) {
    append(solver, t, x);
    return true;
  }
  template <class Solver>
  bool after(const Solver&, const S&, const X& x) {
    last_ = x;
    return true;
  }
  template <class Solver>
  bool settle(Solver&) {
    return false;
  }

 private:
  /// A step, or its part up to an event: the state at its start, and m displacements.
  struct piece {
    S begin, length;
    std::size_t first;
    int degree;
  };

  bool is_forward() const { return pieces_.empty() || pieces_.front().length > S(0); }
  static S node(int j, int m) {
    using std::cos;
    return j == m ? S(1) : S((1 - cos(S(std::numbers::pi_v<long double> * j / m))) / 2);
  }

  template <class Solver>
  void append(const Solver& solver, const S& t, const X& x) {
    if (t == end_) return void(last_ = x);
    const S length = t - end_, whole = solver.time() - solver.previous_time();
    if (!pieces_.empty() && (length > S(0)) != is_forward())
      detail::raise<bad_argument>("kte: a solution must not reverse its direction");
    const int m = solver.dense_degree();
    const std::size_t first = numbers_.size();
    const X& from = solver.previous_state();
    numbers_.insert(numbers_.end(), from.data(), from.data() + from.size());
    for (int j = 1; j <= m; ++j) {
      d_ = solver.displacement_to(S(node(j, m) * (length / whole)));
      numbers_.insert(numbers_.end(), d_.data(), d_.data() + d_.size());
    }
    pieces_.push_back({end_, length, first, m});
    end_ = t;
    last_ = x;
  }

  void evaluate_piece(const piece& p, const S& t, X& x) const {
    const S theta = (t - p.begin) / p.length;
    if constexpr (requires { detail::unwrapped(motion_).settle_at(t); }) detail::unwrapped(motion_).settle_at(t);
    const typename X::Scalar* numbers = numbers_.data() + p.first;
    from_ = Eigen::Map<const X>(numbers, last_.size());
    numbers += last_.size();
    d_.setZero();
    S sum(0);
    for (int j = 0; j <= p.degree; ++j) {
      const S away = theta - node(j, p.degree);
      if (away == S(0)) {
        if (j == 0) return void(x = from_);
        d_ = Eigen::Map<const rate>(numbers + (j - 1) * d_.size(), d_.size());
        return displace(x);
      }
      const S half = j == 0 || j == p.degree ? S(1) / S(2) : S(1), w = (j % 2 == 0 ? half : S(-half)) / away;
      sum += w;
      if (j > 0) d_ += w * Eigen::Map<const rate>(numbers + (j - 1) * d_.size(), d_.size());
    }
    d_ /= sum;  // (1)
    displace(x);
  }
  /// x = from_ (+) d_
  void displace(X& x) const {
    if constexpr (on_group) {
      detail::unwrapped(motion_).displace(from_, d_, x);
      if constexpr (detail::settles_states<system, X>) detail::unwrapped(motion_).settle(from_, d_, x);
    } else {
      x = from_ + d_;
      if constexpr (uses_system) detail::unwrapped(motion_).settle(from_, x);
    }
  }
  template <class Method>
  static auto motion_of(const integrator<Method, F, X>& solver) {
    if constexpr (uses_system) {
      return solver.function();
    } else {
      return detail::no_value{};
    }
  }

  [[no_unique_address]] std::conditional_t<uses_system, std::remove_const_t<F>, detail::no_value> motion_;
  S begin_, end_;
  X last_;
  std::vector<piece> pieces_;
  std::vector<typename X::Scalar> numbers_;
  mutable X from_;
  mutable rate d_;
};
template <class Method, class F, class X>
solution(const integrator<Method, F, X>&) -> solution<F, X>;

}  // namespace kte
