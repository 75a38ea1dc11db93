#pragma once

#include <kte/dynamics/closed_loops/loop_factor.hpp>
#include <kte/dynamics/looped/derivatives.hpp>

#include <algorithm>

/// Forces that a time step treats implicitly.
namespace kte::detail {

/// Derivatives of forces on degrees of freedom that no element has: those of a control law. Square, by rows of v.
struct force_slopes {
  Eigen::MatrixXd by_q, by_v;  ///< K = -df/dq, D = -df/dv
};

/// The forces of elements between coordinates, and of a control law, in a step h, linear in the unknown velocities:
///
///   M~ = M + A,   A = h D + h^2/2 K,   D = -df/dv,   K = -df/dq                       (1)
///   M~ (v^+ - v) = h (f(q_m, v_m) + D (v_m - v)) + J^T P                               (2)
///
/// Forces on frames are explicit, and so are negative entries of a diagonal A, and an A for which M~ is not positive
/// definite. A is made symmetric. If it is diagonal, trees add it to the masses of their coordinates.
class implicit_forces {
 public:
  /// D, K and A at the state. `law`: the part of a control law, or nullptr.
  void find(const runtime_elements& c, runtime_state& s, double h, const force_slopes* law);
  /// Whether A is not zero and needs M~ by rows.
  bool coupled() const { return coupled_; }
  void leave_out() { none_ = true, coupled_ = false; }
  /// Row i of D (v_m - v).
  double correction(int i, const Eigen::VectorXd& change) const {
    if (none_) return 0;
    return coupled_ ? damping.row(i).dot(change) : (added(i, i) > 0 ? damping(i, i) * change[i] : 0);
  }

  Eigen::MatrixXd damping, added;  ///< D, A

 private:
  void put_masses(runtime_state& s) const;
  bool none_ = true, coupled_ = false;
};

#ifdef KTE_FUNCTION
KTE_FUNCTION void implicit_forces::find(const runtime_elements& c, runtime_state& s, double h,
                                        const force_slopes* law) {
  const auto& t = s.tree();
  coupled_ = false, none_ = t.on_coordinates.empty() && law == nullptr;
  if (none_) return;
  auto& r = s.work.of_forces;
  const Eigen::Index n = s.dofs();
  r.by_q.setZero(n, n), r.by_v.setZero(n, n), r.by_a.setZero(n, n);
  for (const int e : t.on_coordinates) c.derive(e, s);
  if (law != nullptr) r.by_q += law->by_q, r.by_v += law->by_v;
  damping.resize(n, n), added.resize(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index i = 0; i <= k; ++i) {
      damping(i, k) = damping(k, i) = (r.by_v(i, k) + r.by_v(k, i)) / 2;
      added(i, k) = added(k, i) = h * damping(i, k) + h * h / 4 * (r.by_q(i, k) + r.by_q(k, i));
      coupled_ |= i != k && added(i, k) != 0;
    }
  for (const int row : t.plan.jointless_dofs) coupled_ |= added(row, row) != 0;
  coupled_ |= !t.plan.tree && !added.isZero(0);
  if (!coupled_) put_masses(s);
}
KTE_FUNCTION void implicit_forces::put_masses(runtime_state& s) const {
  const auto& t = s.tree();
  auto& w = s.work;
  for (std::size_t k = 0; k < t.body_tree.row.size(); ++k)
    if (const int row = t.body_tree.row[k]; row < s.dofs())
      w.own_mass[k] = t.own_mass[static_cast<std::size_t>(row)] + (std::max)(0.0, added(row, row));
  tree::set_free(t.body_tree, w, [&w](std::size_t i) { return w.is_free[i]; });
}
#endif

}  // namespace kte::detail
