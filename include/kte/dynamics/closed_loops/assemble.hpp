#pragma once

#include <kte/detail/interruption.hpp>
#include <kte/dynamics/closed_loops/constrained_dynamics.hpp>
#include <kte/dynamics/configuration_space.hpp>

namespace kte {

namespace detail {
Eigen::VectorXd assembled(const runtime_chain& c, runtime_state& s, Eigen::VectorXd q,
                          const std::vector<std::string>& held);
}  // namespace detail

/// A configuration with closed loops, from a guess, by the Levenberg-Marquardt method: with the constraint Jacobian J
/// and the residuals g,
///
///   (J^T J + mu 1) d = -J^T g,   q <- q (+) d,   mu ~ |g|^2          (1)
///
/// at most a quarter turn a step. It converges quadratically also with redundant rows. Coordinates that are `held` are
/// unchanged:
///
///   q = kte::assemble(four_bar, s, guess, kte::held("crank"))
///
/// The guess determines which of several assemblies is found. The state is then at q. Throws `cannot_assemble`, naming
/// the closure that stays open and its gap, or that closes half a turn off; `bad_argument`, `unknown_name`.
template <indexable Q>
Eigen::VectorXd assemble(const runtime_chain& c, runtime_state& s, const Q& guess, const held_coordinates& held = {}) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, guess).call([&] {
    return detail::assembled(c, s, detail::read_numbers<detail::vector_of::q>(s), held.names);
  });
}

}  // namespace kte

namespace kte::detail {

/// The degrees of freedom of coordinates, by name. Throws `unknown_name`, `bad_argument`.
std::vector<int> rows_of_coordinates(const runtime_chain& c, const runtime_state& s,
                                     const std::vector<std::string>& names);

/// Whether each degree of freedom is a length.
std::vector<char> sliding_rows(const runtime_state& s);

/// Residuals of a chain over the coordinates that may move, without the degrees of freedom in `held`. set(q) writes
/// positions to the state; moved(q, d) returns q (+) d.
template <class Set, class Moved>
class assembly {
 public:
  assembly(const chain_constraints& c, runtime_state& s, loop_equations& e, const std::vector<int>& held,
           const Set& set, const Moved& moved)
      : closures_(c), state_(s), equations_(e), set_(set), moved_(moved) {
    std::vector<char> is_held(static_cast<std::size_t>(s.dofs()), 0);
    for (const int row : held) is_held[static_cast<std::size_t>(row)] = 1;
    for (int row = 0; row < s.dofs(); ++row)
      if (!is_held[static_cast<std::size_t>(row)]) free_.push_back(row);
    unit_.setOnes(s.dofs());
    const auto slides = sliding_rows(s);
    for (int row = 0; row < s.dofs(); ++row)
      if (slides[static_cast<std::size_t>(row)]) unit_[row] = equations_.places.length;
  }
  /// A configuration on the loops, starting from q. Where no direction brings the ends nearer, as in a linkage that is
  /// folded flat, it starts beside q.
  Eigen::VectorXd from(const Eigen::VectorXd& q) {
    int steps = 0;
    Eigen::VectorXd found = nearest_from(q, steps);
    for (int i = 1; steps == 0 && !is_closed(found) && !free_.empty() && i <= 8; ++i) {
      int more = 0;
      found = nearest_from(moved_(q, beside(i)), more);
    }
    if (!is_closed(found)) {
      (void)nearest_from(q, steps);
      fail(steps, steps < most_steps ? "the nearest approach: bars too short, closures that contradict each other, "
                                       "or another guess"
                                     : "too many: another guess");
    }
    check_upright();
    return found;
  }

 private:
  static constexpr int most_steps = 200;
  /// Whether the loops are closed at the state, whose configuration is q.
  bool is_closed(const Eigen::VectorXd& q) const {
    const double open = gap();
    return open <= 1e-10 || open <= equations_.rounding(state_, q);
  }
  /// The nearest approach to the loops by (1) from q, after `steps` steps. The state is then there.
  Eigen::VectorXd nearest_from(Eigen::VectorXd q, int& steps) {
    double size = at(q), damping = 1;
    bool last = gap() <= 1e-14;
    for (steps = 0; gap() > 1e-15 && steps < most_steps; ++steps) {
      Eigen::VectorXd d, next;
      double after = 0;
      bool better = false;
      for (; damping < 1e18; damping *= 8) {
        look_for_interruption();
        if (!step((std::max)(damping * size, 1e-150), d)) break;
        next = moved_(q, d);
        after = at(next);
        better = after < size;
        if (better) break;
        (void)at(q);
      }
      if (!better) break;  // the nearest that it reaches
      const bool little = after > 0.9999 * size && size > 1e-13;
      q = next, size = after, damping = (std::max)(damping / 8, 1e-3);
      if (last || (little && steps > 50)) break;
      last = gap() <= 1e-14;
    }
    (void)at(q);
    return q;
  }
  /// A small displacement, the same at each call: 0.2 rad, or of the length of the chain, at most.
  Eigen::VectorXd beside(int i) const {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(unit_.size());
    for (const int row : free_) d[row] = 0.2 * unit_[row] * std::sin(i * (2.4 * row + 1));
    return d;
  }
  /// |g|; computes g and J at q.
  double at(const Eigen::VectorXd& q) {
    set_(q);
    equations_.at_positions(closures_, state_, true);
    return equations_.residual.norm();
  }
  double gap() const { return equations_.residual.cwiseAbs().maxCoeff(); }
  /// (1) for the current g and J; false if nothing moves.
  bool step(double mu, Eigen::VectorXd& d) const {
    const auto m = equations_.residual.size(), n = static_cast<Eigen::Index>(free_.size());
    pivoted_qr qr;
    auto b = qr.matrix(m + n, n);
    b.setZero();
    const Eigen::MatrixXd j = equations_.scaled_jacobian();
    for (Eigen::Index k = 0; k < n; ++k) {
      const int row = free_[static_cast<std::size_t>(k)];
      b.col(k).head(m) = unit_[row] * j.col(row);
      b(m + k, k) = mu;
    }
    std::vector<int> all(free_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
    if (!qr.take(all, 0)) return false;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(m + n + pivoted_qr::padding);
    y.head(m) = -equations_.residual;
    qr.times_q_transposed(y.data()), qr.solve(y.data());
    Eigen::VectorXd x = y.head(n);
    constexpr double quarter_turn = 1.5707963267948966;
    if (const double most = x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0; most > quarter_turn) x *= quarter_turn / most;
    d = Eigen::VectorXd::Zero(unit_.size());
    for (std::size_t k = 0; k < free_.size(); ++k) d[free_[k]] = unit_[free_[k]] * x[static_cast<Eigen::Index>(k)];
    return n > 0 && x.cwiseAbs().maxCoeff() > 0;
  }
  [[noreturn]] void fail(int steps, const char* why) const {
    const auto widest = widest_gap(equations_);
    raise<cannot_assemble>("kte: the loops do not close: '" + closures_.loop_name(widest.closure->loop) +
                           "' stays open by " + short_number(widest.size) + (widest.linear ? " m" : " rad") +
                           " after " + std::to_string(steps) + " steps (" + why + ")");
  }
  /// Throws if rotations are at their false solution, half a turn away.
  void check_upright() const {
    for (const auto& x : equations_.places.closures)
      if (x.of_frames() && !closures_.is_upright(x.element, loop_equations::motion_between(state_, x)))
        raise<cannot_assemble>("kte: the loops close, but '" + closures_.loop_name(x.loop) +
                               "' with its frames half a turn apart: another guess");
  }

  static std::string short_number(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3g", x);
    return text;
  }
  const chain_constraints& closures_;
  runtime_state& state_;
  loop_equations& equations_;
  const Set& set_;
  const Moved& moved_;
  std::vector<int> free_;
  Eigen::VectorXd unit_;  ///< by coordinate: the length of the chain, or 1 rad
};

#ifdef KTE_FUNCTION
KTE_FUNCTION Eigen::VectorXd assembled(const runtime_chain& c, runtime_state& s, Eigen::VectorXd q,
                                       const std::vector<std::string>& held) {
  if (!has_loops(c)) return q;
  const auto closures = closures_of(c);
  const auto set = [&s](const Eigen::VectorXd& at) { write_numbers<vector_of::q>(s, at, "q"); };
  const auto moved = [&c](const Eigen::VectorXd& from, const Eigen::VectorXd& d) -> Eigen::VectorXd {
    return integrate(c, from, d, 1.0);
  };
  return assembly(closures, s, loops_of(c, s).equations, rows_of_coordinates(c, s, held), set, moved)
      .from(std::move(q));
}
#endif

#ifdef KTE_FUNCTION
KTE_FUNCTION std::vector<int> rows_of_coordinates(const runtime_chain& c, const runtime_state& s,
                                                  const std::vector<std::string>& names) {
  std::vector<int> rows;
  for (const auto& name : names) {
    const kind k = c.wiring().kind_of(name, false);
    const int slot = c.wiring().find(name, k);
    const auto all = s.freedoms();
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const freedom& f) { return f.what == k && f.slot == slot; });
    if (at == all.end()) throw bad_argument("kte: '" + name + "' is not a degree of freedom of this chain");
    for (int i = 0; i < nv_of(k); ++i) rows.push_back(at->v + i);
  }
  return rows;
}
KTE_FUNCTION std::vector<char> sliding_rows(const runtime_state& s) {
  std::vector<char> slides(static_cast<std::size_t>(s.dofs()), 0);
  const auto& f = s.tree().body_tree;
  for (const auto& r : f.nodes)
    for (int k = 0; k < r.axes; ++k) {
      const int row = f.row[static_cast<std::size_t>(r.first + k)];
      if (row < s.dofs())
        slides[static_cast<std::size_t>(row)] =
            r.moves == tree::joint::prismatic || (r.moves == tree::joint::several && r.axis[std::size_t(k)] < 3);
    }
  return slides;
}
#endif

}  // namespace kte::detail
