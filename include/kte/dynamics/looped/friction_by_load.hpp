#pragma once

#include <kte/dynamics/looped/inverse_dynamics.hpp>

#include <algorithm>

/// Load-dependent friction of joints in the loops over body nodes. `Elements` and states as in
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// The friction of the i-th joint with load-dependent friction.
template <class Elements, class State>
[[noreturn, gnu::cold, gnu::noinline]] void diagnose_friction(const Elements& c, const State& s, Eigen::Index i) {
  const auto& t = s.tree();
  const int e = t.readers[static_cast<std::size_t>(i)];
  const int slot = t.body_tree.frame(c.ports(e).back().what, c.written(e)).slot - t.body_tree.bases;
  c.diagnose_friction(
      s, t.body_tree.row[static_cast<std::size_t>(t.body_tree.nodes[static_cast<std::size_t>(slot)].first)]);
}

/// Accelerations with load-dependent friction of joints. sweep() computes accelerations with the friction x in the
/// working memory; friction(a) follows from them. Solves
///
///   r(x) = friction(a(x)) - x = 0          (1)
///
/// to rounding by Broyden's first method (Math. Comp. 19 (1965)). If it diverges at the kink of an unloaded joint,
/// Newton's method with differences and shortened steps is used. If r' is so close to singular that x loses half its
/// digits, |r'^-1| |x| > |x| / sqrt(eps), joints are about to jam (Painleve 1895); beyond that point there is no x.
/// Throws `no_solution` in both cases, with the first such coordinate.
template <class Elements, class State, class Sweep>
class friction_iteration {
  using S = typename State::scalar;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

 public:
  friction_iteration(const Elements& c, State& s, const Sweep& sweep)
      : c_(c),
        s_(s),
        sweep_(sweep),
        n_(static_cast<Eigen::Index>(s.tree().readers.size())),
        inverse_(-matrix::Identity(n_, n_)),
        x_(vector::Zero(n_)),
        r_(n_) {}

  void solve() {
    evaluate();
    if (!by_broyden() && !by_newton()) diagnose_friction(c_, s_, 0);
    check_sure();
  }

 private:
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

  bool by_broyden() {
    best_ = x_;
    S least = (std::numeric_limits<S>::max)();
    for (int i = 0, idle = 0; i < 60; ++i) {
      const S error = largest(r_);
      if (is_rounding(error, 4)) return true;
      idle = all(error < S(least / S(2))) ? 0 : idle + 1;
      if (all(error < least)) best_ = x_;
      least = select(error < least, error, least);
      if (idle >= 3 && (idle >= 8 || all(error <= S(2 * least))) && is_rounding(error, 4096)) return true;
      const vector step = -times_inverse(r_), before = r_;
      x_ += step;
      evaluate();
      if (!all(largest(step) <= S(S(4096) * eps * largest(x_)))) learn(step, before);  // r - before exceeds rounding
    }
    return false;
  }
  bool by_newton() {
    x_ = best_;
    evaluate();
    for (int i = 0; i < 30; ++i) {
      const S error = largest(r_);
      if (is_rounding(error, 64)) return true;
      const vector from = x_, before = r_;
      for (Eigen::Index k = 0; k < n_; ++k) {
        using std::sqrt;
        vector step = vector::Zero(n_);
        step[k] = S(sqrt(eps)) * largest(from);
        x_ = from + step;
        evaluate();
        learn(step, before);
      }
      const vector step = -times_inverse(before);
      S share(1);
      do {
        x_ = from + share * step;
        evaluate();
        share = S(share / S(2));
      } while (!all(largest(r_) < error) && all(share > S(1e-4)));
      if (!all(largest(r_) < error)) return is_rounding(error, 4096);
    }
    return false;
  }

  /// Evaluates r at x.
  void evaluate() {
    std::copy(x_.begin(), x_.end(), s_.work.friction.begin());
    sweep_();
    forces_on_coordinates(c_, s_, acting::with_given_friction);
    Eigen::Index i = 0;
    for_each_friction(c_, s_, [&](const auto&, const S& f) { r_[i] = f - x_[i], ++i; });
  }
  /// Broyden's update of r'^-1, by the Sherman-Morrison formula. After steps along all axes it equals differences.
  void learn(const vector& step, const vector& before) {
    const vector gone = times_inverse(vector(r_ - before));
    S along(0);
    for (Eigen::Index k = 0; k < n_; ++k) along += step[k] * gone[k];
    const S share = select(along == S(0), S(0), S(S(1) / select(along == S(0), S(1), along)));
    vector column(n_);
    for (Eigen::Index j = 0; j < n_; ++j) {
      S across(0);
      for (Eigen::Index k = 0; k < n_; ++k) across += step[k] * inverse_(k, j);
      for (Eigen::Index k = 0; k < n_; ++k) column[k] = inverse_(k, j) + share * (step[k] - gone[k]) * across;
      inverse_.col(j) = column;
    }
  }
  void check_sure() const {
    using std::abs;
    using std::sqrt;
    const S most = largest(x_) / S(sqrt(eps));
    for (Eigen::Index i = 0; i < n_; ++i) {
      S unsure(0);
      for (Eigen::Index j = 0; j < n_; ++j) unsure += S(abs(inverse_(i, j))) * S(abs(x_[j]));
      if (!all(unsure <= most)) [[unlikely]]
        diagnose_friction(c_, s_, i);
    }
  }
  bool is_rounding(const S& error, int units) const { return all(error <= S(S(units) * eps * largest(x_))); }
  static S largest(const vector& y) {
    using std::abs;
    S most(0);
    for (const S& i : y) most = select(most < S(abs(i)), S(abs(i)), most);
    return most;
  }
  vector times_inverse(const vector& y) const {  // Eigen's products do not support packs
    vector product = vector::Zero(n_);
    for (Eigen::Index i = 0; i < n_; ++i)
      for (Eigen::Index j = 0; j < n_; ++j) product[i] += inverse_(i, j) * y[j];
    return product;
  }

  const S eps = std::numeric_limits<S>::epsilon();
  const Elements& c_;
  State& s_;
  const Sweep& sweep_;
  Eigen::Index n_;
  matrix inverse_;  ///< of r'
  vector x_, r_, best_;
};

}  // namespace kte::detail
