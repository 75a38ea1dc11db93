#pragma once

#include <kte/dynamics/closed_loops/loop_equations.hpp>
#include <kte/dynamics/closed_loops/mass_root.hpp>
#include <kte/dynamics/closed_loops/pivoted_qr.hpp>
#include <kte/dynamics/looped/forward_dynamics.hpp>

/// The independent rows of closures, and the least change of a motion, measured by kinetic energy, that satisfies them.
///
///   M = L^T L                                                                     (1)
///   B = L^-T J^T,   so that B^T B = J M^-1 J^T                                    (2)
///   B_S = Q R,  S: the rows of J that column pivoting chooses                     (3)
///   d = L^-1 Q R^-T c:  J_S d = c_S with the least d^T M d                        (4)
///   lambda_S = R^-1 R^-T c: M d = J_S^T lambda_S                                  (5)
///
/// In trees, L^-T passes loads to the bases, and L^-1 passes accelerations back (tree/loop_loads.hpp): with the D of
/// articulated bodies, an entry of B is e D^-1/2 (Rodriguez, Jain and Kreutz-Delgado, Int. J. Robotics Research 10,
/// 1991). Other chains factorize M. J M^-1 J^T is never factorized, because its condition number is squared.
namespace kte::detail {

class loop_factor {
  /// (5) for `half_change`.
  auto put_multipliers(const loop_equations& e, Eigen::VectorXd& lambda) {
    lambda.setZero(e.places.rows);
    return [this, &e, &lambda](const pivoted_qr& p, const loop_block& b) {
      p.solve(chosen_.data());
      for (std::size_t k = 0; k < p.chosen.size(); ++k)
        lambda[e.places.row_of(b, p.chosen[k])] = chosen_[static_cast<Eigen::Index>(k)];
    };
  }

 public:
  /// (1) at the positions of the state, for use at other positions too; call `at_positions` first, with J unless the
  /// chain is a tree.
  void factorize(const chain_constraints& c, runtime_state& s, const loop_equations& e);
  /// (1) for M + A, by its rows; call `at_positions` with J first. Returns false if M + A is not positive definite.
  bool factorize_mass(const chain_constraints& c, runtime_state& s, const loop_equations& e,
                      const Eigen::MatrixXd* added = nullptr);
  /// Whether it factorizes M by rows.
  bool is_dense() const { return dense_; }
  /// x becomes (M + A)^-1 x after `factorize_mass`.
  void solve_mass(Eigen::VectorXd& x) const { mass_.half_solve(x.data()), mass_.other_half(x.data()); }
  /// (1) for a tree from the articulated inertias in the working memory of the state; valid until the next recursion
  /// writes there.
  void take_articulated(const runtime_state& s, const loop_equations& e);
  /// (2) and (3); call (1) at the positions of the state first. Rows with pivots below `least` times the first are
  /// dependent. With `Accelerate` also the second derivatives of residuals (`loop_equations::half_solve`).
  template <bool Accelerate = false>
  void choose(const chain_constraints& c, runtime_state& s, loop_equations& e, double least) {
    parts.resize(e.places.blocks.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& b = e.places.blocks[i];
      put_half_solved<Accelerate>(c, s, e, i, parts[i].matrix(static_cast<Eigen::Index>(b.places.size()), b.rows));
      parts[i].choose(least, 1e-13 * reach(e, i));  // pivots below the rounding of their possible size are zero
      if (!parts[i].is_finite) [[unlikely]]
        raise<bad_argument>("kte: the loops of " + e.places.names_in(c, b, "'", 3) +
                            ": a derivative of their residuals is not finite at this configuration");
    }
  }
  /// (2) and (3) for the rows of `chosen`. Returns false if they are dependent.
  template <bool Accelerate = false>
  bool keep(const chain_constraints& c, runtime_state& s, loop_equations& e, const loop_factor& chosen, double least) {
    parts.resize(e.places.blocks.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& rows = chosen.parts[i].chosen;
      const auto& b = e.places.blocks[i];
      all_.resize(static_cast<Eigen::Index>(b.places.size()), b.rows);
      put_half_solved<Accelerate>(c, s, e, i, all_);
      auto m = parts[i].matrix(all_.rows(), static_cast<Eigen::Index>(rows.size()));
      for (std::size_t k = 0; k < rows.size(); ++k) m.col(static_cast<Eigen::Index>(k)) = all_.col(rows[k]);
      if (!parts[i].take(rows, least)) return false;
    }
    return true;
  }
  /// The smallest pivot of block i relative to its possible size; it tends to zero near singular configurations. 1 if
  /// its closures constrain nothing.
  double smallest_pivot(const loop_equations& e, std::size_t i) const {
    return parts[i].rank() > 0 ? parts[i].smallest / reach(e, i) : 1;
  }
  int rank() const {
    Eigen::Index n = 0;
    for (const auto& p : parts) n += p.rank();
    return static_cast<int>(n);
  }
  /// (4) for c of all rows, by degrees of freedom. Overwrites the motion in the working memory of the state.
  void least_change(runtime_state& s, const loop_equations& e, const Eigen::VectorXd& c, Eigen::VectorXd& d) {
    least_change(s, e, c, d, [](const pivoted_qr&, const loop_block&) {});
  }
  /// (4) and (5); lambda is zero for rows that are not selected.
  void least_change(runtime_state& s, const loop_equations& e, const Eigen::VectorXd& c, Eigen::VectorXd& d,
                    Eigen::VectorXd& lambda) {
    least_change(s, e, c, d, put_multipliers(e, lambda));
  }
  /// For a tree with articulated inertias in the working memory of the state: subtracts (4) from the rates u D^-1 of
  /// axes, and M times (4) from the forces on coordinates that move no joint; with (5).
  void subtract_change(runtime_state& s, const loop_equations& e, const Eigen::VectorXd& c, Eigen::VectorXd& lambda);
  Eigen::VectorXd least_change(runtime_state& s, const loop_equations& e, const Eigen::VectorXd& c) {
    Eigen::VectorXd d;
    least_change(s, e, c, d);
    return d;
  }
  /// Adds L^-1 y, y by places, to the accelerations that a tree with articulated inertias in the working memory of the
  /// state is about to get.
  void add_half_change(runtime_state& s, const loop_equations& e, const Eigen::VectorXd& y) const;
  /// d = L^-1 y, y by places, which may be overwritten; d by degrees of freedom. Overwrites the motion in the working
  /// memory of the state.
  void other_half(runtime_state& s, const loop_equations& e, Eigen::VectorXd& y, Eigen::VectorXd& d);
  /// As `other_half`, for column k of Q of block i.
  void other_half_of_q(runtime_state& s, const loop_equations& e, std::size_t i, Eigen::Index k, Eigen::VectorXd& d);
  /// Calls put(place, row, entry) for L^-T J^T of the rows of a closure; call (1) at the positions of the state first.
  template <bool Accelerate = false, class Put>
  void half_solve(const chain_constraints& c, runtime_state& s, loop_equations& e, int closure, const Put& put) {
    std::size_t i = 0;
    int first = 0;
    for (;; ++i, first = 0) {
      const auto& in_block = e.places.blocks[i].closures;
      std::size_t k = 0;
      for (; k < in_block.size() && in_block[k] != closure; ++k)
        first += e.places.closures[static_cast<std::size_t>(in_block[k])].rows.count();
      if (k < in_block.size()) break;
    }
    const auto& places = e.places.blocks[i].places;
    if (!dense_)
      return e.half_solve<Accelerate>(c, s, closure, root_, [&](int column, int row, double entry) {
        put(places[static_cast<std::size_t>(column)], row, entry);
      });
    const int rows = e.places.closures[static_cast<std::size_t>(closure)].rows.count();
    for (int r = 0; r < rows; ++r) {
      half_ = e.jacobian[i].row(first + r).transpose();
      mass_.half_solve(half_.data());
      for (std::size_t k = 0; k < places.size(); ++k) put(places[k], r, half_[static_cast<Eigen::Index>(k)]);
    }
  }
  /// As `half_solve` in a tree, for `loop_equations::half_solve_units`.
  template <bool Accelerate, class Put, class Accelerated>
  void half_solve_units(runtime_state& s, loop_equations& e, int closure, const double* units, int rows, const Put& put,
                        const Accelerated& accelerate) const {
    e.half_solve_units<Accelerate>(s, closure, units, rows, root_, put, accelerate);
  }
  bool is_chosen(const loop_equations& e, int row) const;
  /// The largest entry of c among the selected rows.
  double largest_of_chosen(const loop_equations& e, const Eigen::VectorXd& c) const;

  std::vector<pivoted_qr> parts;  ///< by block

 private:
  /// Calls visit(axis or -1, row, D^-1/2 y) by place.
  template <class Visit>
  void each_rate(const loop_equations& e, const Eigen::VectorXd& y, const Visit& visit) const {
    for (std::size_t k = 0; k < e.places.axis_of_place.size(); ++k)
      visit(e.places.axis_of_place[k], e.places.row_of_place[k],
            y[static_cast<Eigen::Index>(k)] * root_[static_cast<Eigen::Index>(k)]);
  }
  /// Q R^-T c of (4), to `left_`; calls visit(factor of a block, the block) when R^-T c of its selected rows is in
  /// `chosen_`.
  template <class Visit>
  void half_change(const loop_equations& e, const Eigen::VectorXd& c, const Visit& visit) {
    const auto& at = e.places;
    const auto n = static_cast<Eigen::Index>(at.row_of_place.size());
    left_.setZero(n);
    if (chosen_.size() < at.rows) chosen_.resize(at.rows);
    if (half_.size() < n + pivoted_qr::padding) half_.resize(n + pivoted_qr::padding);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& b = at.blocks[i];
      const auto& p = parts[i];
      for (std::size_t k = 0; k < p.chosen.size(); ++k)
        chosen_[static_cast<Eigen::Index>(k)] = c[at.row_of(b, p.chosen[k])];
      p.solve_transposed(chosen_.data());
      p.times_q(chosen_.data(), half_.data());
      for (std::size_t k = 0; k < b.places.size(); ++k) left_[b.places[k]] = half_[static_cast<Eigen::Index>(k)];
      visit(p, b);
    }
  }
  /// (4), with `visit` of `half_change`.
  template <class Visit>
  void least_change(runtime_state& s, const loop_equations& e, const Eigen::VectorXd& c, Eigen::VectorXd& d,
                    const Visit& visit) {
    half_change(e, c, visit);
    other_half(s, e, left_, d);
  }
  /// The possible size of a row of B of block i.
  double reach(const loop_equations& e, std::size_t i) const {
    double most = 0;
    for (const int k : e.places.blocks[i].places) most = (std::max)(most, root_[k]);
    return most * (std::min)(1.0, 1 / e.places.length);
  }
  /// (2) for block i.
  template <bool Accelerate>
  void put_half_solved(const chain_constraints& c, runtime_state& s, loop_equations& e, std::size_t i,
                       Eigen::Ref<Eigen::MatrixXd> b) const {
    if (dense_) {
      b = e.jacobian[i].transpose();
      for (Eigen::Index k = 0; k < b.cols(); ++k) mass_.half_solve(b.col(k).data());
      return;
    }
    if (e.places.blocks[i].closures.size() > 1) b.setZero();
    int first = 0;
    for (const int k : e.places.blocks[i].closures) {
      e.half_solve<Accelerate>(c, s, k, root_,
                               [&](int column, int row, double entry) { b(column, first + row) = entry; });
      first += e.places.closures[static_cast<std::size_t>(k)].rows.count();
    }
  }
  Eigen::VectorXd root_;                 ///< D^-1/2, or 1 / L_kk, by place
  tree::articulated_tree<double> kept_;  ///< at the positions of the factorization
  bool keeps_ = false;
  bool dense_ = false;  ///< by rows of M, in `mass_`
  mass_root mass_;
  Eigen::MatrixXd all_;
  Eigen::VectorXd left_, chosen_, half_;
};

#ifdef KTE_FUNCTION
KTE_FUNCTION void loop_factor::factorize(const chain_constraints& c, runtime_state& s, const loop_equations& e) {
  if (!s.tree().plan.tree) return (void)factorize_mass(c, s, e);
  prescribe(s, {});
  if (const int bad = tree::articulate_at_rest(s.tree().body_tree, s.work); bad >= 0) [[unlikely]]
    diagnose_axis(c, s, bad);
  check_jointless_masses(c, s);
  take_articulated(s, e);
  kept_.joint_transforms = s.work.joint_transforms, kept_.factors = s.work.factors;
  keeps_ = true;
}
KTE_FUNCTION bool loop_factor::factorize_mass(const chain_constraints& c, runtime_state& s, const loop_equations& e,
                                              const Eigen::MatrixXd* added) {
  if (!mass_.factorize(c, s, added)) return false;
  root_.resize(static_cast<Eigen::Index>(e.places.row_of_place.size()));
  for (Eigen::Index k = 0; k < root_.size(); ++k) root_[k] = mass_.inverse_root(static_cast<int>(k));
  dense_ = true;
  return true;
}
KTE_FUNCTION void loop_factor::take_articulated(const runtime_state& s, const loop_equations& e) {
  const auto& at = e.places;
  root_.resize(static_cast<Eigen::Index>(at.row_of_place.size()));
  for (std::size_t k = 0; k < at.axis_of_place.size(); ++k) {
    const int axis = at.axis_of_place[k];
    root_[static_cast<Eigen::Index>(k)] =
        axis >= 0 ? std::sqrt(s.work.factors[static_cast<std::size_t>(axis)].inverse)
                  : 1 / std::sqrt(s.tree().own_mass[static_cast<std::size_t>(at.row_of_place[k])]);
  }
  keeps_ = false, dense_ = false;
}
KTE_FUNCTION void loop_factor::subtract_change(runtime_state& s, const loop_equations& e, const Eigen::VectorXd& c,
                                               Eigen::VectorXd& lambda) {
  half_change(e, c, put_multipliers(e, lambda));
  each_rate(e, left_, [&s](int axis, int row, double rate) {
    if (axis >= 0)
      s.work.factors[static_cast<std::size_t>(axis)].rate -= rate;
    else
      s.work.forces[row] -= s.tree().own_mass[static_cast<std::size_t>(row)] * rate;
  });
}
KTE_FUNCTION void loop_factor::add_half_change(runtime_state& s, const loop_equations& e,
                                               const Eigen::VectorXd& y) const {
  each_rate(e, y, [&s](int axis, int row, double rate) {
    if (axis >= 0)
      s.work.factors[static_cast<std::size_t>(axis)].rate += rate;
    else
      s.work.forces[row] += s.tree().own_mass[static_cast<std::size_t>(row)] * rate;
  });
}
KTE_FUNCTION void loop_factor::other_half(runtime_state& s, const loop_equations& e, Eigen::VectorXd& y,
                                          Eigen::VectorXd& d) {
  const auto& at = e.places;
  const auto n = static_cast<Eigen::Index>(at.row_of_place.size());
  d.resize(n);
  if (dense_) {
    mass_.other_half(y.data());
    d = y.head(n);
    return;
  }
  auto& factors = keeps_ ? kept_.factors : s.work.factors;
  each_rate(e, y, [&](int axis, int row, double rate) {
    (axis >= 0 ? factors[static_cast<std::size_t>(axis)].rate : d[row]) = rate;
  });
  tree::accelerate_from_rest(s.tree().body_tree, s.work, keeps_ ? kept_.joint_transforms : s.work.joint_transforms,
                             factors.data());
  for (std::size_t k = 0; k < at.axis_of_place.size(); ++k)
    if (const int axis = at.axis_of_place[k]; axis >= 0)
      d[at.row_of_place[k]] = s.work.acceleration[static_cast<std::size_t>(axis)];
}
KTE_FUNCTION void loop_factor::other_half_of_q(runtime_state& s, const loop_equations& e, std::size_t i, Eigen::Index k,
                                               Eigen::VectorXd& d) {
  const auto n = static_cast<Eigen::Index>(e.places.row_of_place.size());
  const auto& places = e.places.blocks[i].places;
  left_.setZero(n);
  if (half_.size() < n + pivoted_qr::padding) half_.resize(n + pivoted_qr::padding);
  parts[i].column_of_q(k, half_.data());
  for (std::size_t j = 0; j < places.size(); ++j) left_[places[j]] = half_[static_cast<Eigen::Index>(j)];
  other_half(s, e, left_, d);
}
KTE_FUNCTION bool loop_factor::is_chosen(const loop_equations& e, int row) const {
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const int k : parts[i].chosen)
      if (e.places.row_of(e.places.blocks[i], k) == row) return true;
  return false;
}
KTE_FUNCTION double loop_factor::largest_of_chosen(const loop_equations& e, const Eigen::VectorXd& c) const {
  double most = 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const int k : parts[i].chosen) {
      const double x = std::abs(c[e.places.row_of(e.places.blocks[i], k)]);
      if (!(x <= most) && most == most) most = x;  // NaN stays
    }
  return most;
}
#endif

}  // namespace kte::detail
