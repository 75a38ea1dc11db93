#pragma once

#include <kte/dynamics/closed_loops/forward.hpp>
#include <kte/dynamics/closed_loops/loop_factor.hpp>

/// Accelerations and closure forces of a runtime chain with loops, in the working memory of a state.
namespace kte::detail {

/// Pivots below this part of the first are zero, where rows are chosen.
inline constexpr double least_pivot = 1e-10;

struct loop_memory_of_state {
  std::shared_ptr<const char> layout;
  loop_equations equations;
  loop_factor factor;

  loop_memory_of_state(const runtime_chain& c, const runtime_state& s) : layout(c.wiring().layout), equations(c, s) {}
};
inline loop_memory_of_state& loops_of(const runtime_chain& c, runtime_state& s) {
  const auto make = [&] { return loop_memory_of_state(c, s); };
  auto& m = s.loops.get<loop_memory_of_state>(make);
  if (m.layout != c.wiring().layout) m = make();
  return m;
}

/// Throws `bad_argument` for what loops do not go with.
inline void check_loops(const runtime_chain& c, const runtime_state& s) {
  const auto refuse = [&](int e, const char* why) {
    throw bad_argument("kte: " + describe_element(runtime_elements{c}.element(e)) + why);
  };
  if (!s.tree().locks.empty()) [[unlikely]]
    refuse(s.tree().locks.front(), " may lock a coordinate, which chains with closures do not know");
  if (!s.tree().readers.empty()) [[unlikely]]
    refuse(s.tree().readers.front(), " has load-dependent friction, which chains with closures do not know");
}
/// The pivot that counts as zero where residuals are as they are: rows that depend on others on the loops do not, as
/// far as the state is away from them.
inline double least_pivot_at(const Eigen::VectorXd& residual) {
  const double gap = residual.size() > 0 ? residual.cwiseAbs().maxCoeff() : 0;
  return gap < 1e-8 ? (std::max)(least_pivot, 100 * gap) : least_pivot;
}
inline void put_loop_forces(const closure_places& at, const Eigen::VectorXd& multipliers, runtime_state& s) {
  for (const auto& x : at.closures) {
    auto& loop = s.get<kind::loop>(x.loop);
    for (int r = 0; r < x.rows.count(); ++r)
      row_of(loop.force, loop.torque, x.rows, r) = at.scale(x, r) * multipliers[x.first + r];
  }
}

/// Accelerations under applied(i), into `forces` of the working memory and into the state, with the forces of closures:
///
///   a = a0 - d(J_dot v + J a0),   lambda = -multipliers(J_dot v + J a0)          (1)
///
/// a0: those of the tree. Rows are those of `rows`, or chosen here where there are none or they are dependent.
template <class Tau>
const Eigen::VectorXd& constrained_accelerations(const runtime_chain& c, runtime_state& s, const Tau& applied,
                                                 const loop_factor* rows = nullptr) {
  check_loops(c, s);
  Eigen::VectorXd a = accelerations_under(c, s, applied);
  auto& [layout, e, factor] = loops_of(c, s);
  e.at_positions(c, s, true);
  if (!rows || !factor.keep(c, s, e, *rows, least_pivot)) factor.choose(c, s, e, least_pivot_at(e.residual));
  e.at_rates(c, s);
  const Eigen::VectorXd off = e.acceleration + e.times(a);
  a -= factor.least_change(e, off);
  put_loop_forces(e.places, -factor.multipliers(e, off), s);
  check_result(a, static_cast<std::size_t>(a.size()), diagnose_state{"an acceleration", s});
  s.work.forces = a;
  write_numbers<vector_of::a>(s, a, "a");
  return s.work.forces;
}

inline const bool loops_are_known = [] {
  accelerations_on_loops = [](const runtime_chain& c, runtime_state& s) -> const Eigen::VectorXd& {
    const std::vector<double> applied = s.work.kept;
    return constrained_accelerations(c, s, [&applied](int i) { return applied[static_cast<std::size_t>(i)]; });
  };
  return true;
}();

}  // namespace kte::detail
