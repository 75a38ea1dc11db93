#pragma once

#include <kte/dynamics/looped/cluster_dynamics.hpp>
#include <kte/dynamics/looped/friction_by_load.hpp>
#include <kte/dynamics/looped/mass_matrix.hpp>
#include <kte/kernels/solve.hpp>
#include <kte/tree/articulated.hpp>

#include <span>

/// Forward dynamics as loops over body nodes, in the working memory of a state whose coordinates and bases are set and
/// checked. For all `Elements` and states of dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// Sets the rows whose accelerations are given; an empty span means none. Other joints are free to move.
template <class State>
void prescribe(State& s, std::span<const char> prescribed) {
  const auto& f = s.tree().body_tree;
  auto& w = s.work;
  if (prescribed.empty() && !w.some_prescribed) return;
  std::fill(w.prescribed.begin(), w.prescribed.end(), 0);
  std::copy(prescribed.begin(), prescribed.end(), w.prescribed.begin());
  w.some_prescribed = !prescribed.empty();
  tree::set_free(f, w, [&](std::size_t i) {
    const auto& r = f.nodes[i];
    return r.is_free && !w.prescribed[static_cast<std::size_t>(f.row[static_cast<std::size_t>(r.first)])];
  });
}
/// Masses of coordinates that move no joint.
template <class Elements, class State>
void check_jointless_masses(const Elements& c, const State& s) {
  for (const int row : s.tree().plan.jointless_dofs)
    if (!s.work.prescribed[static_cast<std::size_t>(row)] && !all(s.tree().own_mass[static_cast<std::size_t>(row)] > 0))
        [[unlikely]]
      c.diagnose_mass(s, row, true);
}
/// Articulated inertias and bias forces under the forces tau(i) and those of the elements; for trees. Rows that are
/// `prescribed` keep the accelerations of the state. Returns the bias motions, for `accelerate_after`.
template <class Elements, class State>
auto articulate_under(const Elements& c, State& s, const tree::given_forces<typename State::scalar>& tau,
                      std::span<const char> prescribed) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  prescribe(s, prescribed);
  place_bodies(c, s);
  take_rates(s), take_bases(s);
  const tree::articulated_bodies bodies(t.body_tree, w);
  const auto biases = tree::bias_motions(bodies, w);
  if (t.on_coordinates.empty() && t.on_frames.empty()) {
    for (int i = 0; i < s.dofs(); ++i) w.forces[i] = tau(i);
  } else {
    push_by_rates(c, s);
    read_listed_numbers<vector_of::f>(s, w.forces);
    for (int i = 0; i < s.dofs(); ++i) w.forces[i] += tau(i);
  }
  for (std::size_t k = 0; k < t.body_tree.row.size(); ++k)
    w.force[k] = t.body_tree.row[k] < s.dofs() ? w.forces[t.body_tree.row[k]] : S(0);
  int unmoved = -1;
  engine::articulate<tree::articulated_body<S>>(engine::looped{bodies}, w.articulated.data(), biases,
                                                tree::bias_wrench<S>{{w.loads.data()}},
                                                tree::forces_on_axes<S>{w.force.data()}, w.factors.data(), unmoved);
  if (unmoved >= 0) [[unlikely]]
    diagnose_axis(c, s, unmoved);
  if (!t.on_frames.empty() || !t.late.empty()) take_rates(s);  // accelerations of prescribed joints
  check_jointless_masses(c, s);
  return biases;
}
/// Accelerations after `articulate_under`, from the motions of bases, written to `forces`.
template <class State, class Biases>
void accelerate_after(State& s, const Biases& biases) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  const tree::articulated_bodies bodies(t.body_tree, w);
  engine::accelerate<tree::accelerated_body<S>>(engine::looped{bodies}, w.bodies.data(), biases, w.factors.data(),
                                                w.acceleration.data());
  for (std::size_t k = 0; k < t.body_tree.row.size(); ++k)
    if (t.body_tree.row[k] < s.dofs()) w.forces[t.body_tree.row[k]] = w.acceleration[k];
  for (const int row : t.plan.jointless_dofs) {
    if (!w.prescribed[static_cast<std::size_t>(row)]) {
      w.forces[row] /= t.own_mass[static_cast<std::size_t>(row)];
      continue;
    }
    for_each_listed_freedom(s, [&](const auto& x, const freedom& at) {
      if (at.v == row) visit_a(x, [&](const auto& a) { w.forces[row] = a; });
    });
  }
}

/// Forward dynamics of any chain, by factorization of its mass matrix.
template <class Elements, class State>
void accelerate_by_mass(const Elements& c, State& s, const tree::given_forces<typename State::scalar>& tau,
                        std::span<const char> prescribed) {
  using S = typename State::scalar;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  const int n = s.dofs();
  vector given;
  if (!prescribed.empty()) given.resize(n), read_listed_numbers<vector_of::a>(s, given);
  for_each_listed_freedom(s, [](auto& x, const freedom&) { visit_a(x, [](S& a) { a = S(0); }); });
  forces_on_coordinates(c, s, acting::with_given_friction);
  auto& a = s.work.forces;
  read_listed_numbers<vector_of::f>(s, a);
  for (int i = 0; i < n; ++i) a[i] += tau(i);
  mass_of_coordinates(c, s);
  const auto fail = [&](int row) { c.diagnose_mass(s, row, true); };
  if (prescribed.empty()) return solve_in_place(s.work.mass, a, fail);
  for_each_listed_freedom(s, [&](auto& x, const freedom& at) { put<vector_of::a>(x, at, given); });
  for (int i = 0; i < n; ++i)
    if (prescribed[static_cast<std::size_t>(i)]) a[i] = given[i];
  solve_partly_known(s.work.mass, a, prescribed, fail);
}
/// Whether the accelerations of some but not all coordinates of a joint are prescribed.
template <class State>
bool some_of_joint_prescribed(const State& s, std::span<const char> prescribed) {
  const auto& f = s.tree().body_tree;
  if (prescribed.empty()) return false;
  for (const int i : f.varying) {
    const auto& r = f.nodes[static_cast<std::size_t>(i)];
    const auto is = [&](int k) { return r.is_free && prescribed[static_cast<std::size_t>(f.row[std::size_t(k)])]; };
    for (int k = r.first + 1; k < r.first + r.axes; ++k)
      if (is(k) != is(r.first)) return true;
  }
  return false;
}
/// Whether coordinates that follow others are in clusters, and no acceleration is prescribed.
template <class State>
bool goes_by_clusters(const State& s, std::span<const char> prescribed) {
  return s.tree().clusters.complete &&
         std::none_of(prescribed.begin(), prescribed.end(), [](char given) { return given != 0; });
}
/// Forward dynamics with load-dependent friction, by articulated bodies in a `tree`, else by the mass matrix.
template <class Elements, class State>
void accelerate_with_friction(const Elements& c, State& s, const tree::given_forces<typename State::scalar>& tau,
                              std::span<const char> prescribed, bool tree) {
  using S = typename State::scalar;
  const auto& readers = s.tree().readers;
  Eigen::Matrix<S, Eigen::Dynamic, 1> all(s.dofs()), given(s.dofs());
  read_listed_numbers<vector_of::a>(s, given);
  const auto sweep = [&] {
    for_each_listed_freedom(s, [&](auto& x, const freedom& at) { put<vector_of::a>(x, at, given); });
    for (int i = 0; i < s.dofs(); ++i) all[i] = tau(i);
    for (std::size_t k = 0; tree && k < readers.size(); ++k)  // with M, friction is needed on all coordinates together
      if (const int row = s.tree().plan.joint_row[static_cast<std::size_t>(readers[k])]; row < s.dofs())
        all[row] += s.work.friction[k];
    const tree::given_forces<typename State::scalar> applied(all.data());
    if (tree)
      accelerate_after(s, articulate_under(c, s, applied, prescribed));
    else
      accelerate_by_mass(c, s, applied, prescribed);
    for_each_listed_freedom(s, [&](auto& x, const freedom& at) { put<vector_of::a>(x, at, s.work.forces); });
  };
  friction_iteration(c, s, sweep).solve();
}

/// Calls visit(element, row of the coordinate that it holds).
template <class Elements, class State, class Visit>
void for_each_held(const Elements& c, State& s, const Visit& visit) {
  for (const int e : s.tree().locks)
    if (c.holds(e, s)) visit(e, s.tree().plan.row_of_gen[static_cast<std::size_t>(c.index(e, 0))]);
}
/// The rows whose accelerations are given: `prescribed`, and locked coordinates, whose accelerations are set to zero.
/// `rows`: memory for the result if a coordinate is locked.
template <class Elements, class State>
std::span<const char> with_locked_rows(const Elements& c, State& s, std::span<const char> prescribed,
                                       std::vector<char>& rows) {
  for_each_held(c, s, [&](int e, int row) {
    if (rows.empty()) {
      rows.assign(prescribed.begin(), prescribed.end());
      rows.resize(static_cast<std::size_t>(s.dofs()));
    }
    char& is_prescribed = rows[static_cast<std::size_t>(row)];
    if (!is_prescribed) s.template get<kind::gen>(c.index(e, 0)).q_ddot = typename State::scalar(0);
    is_prescribed = 1;
  });
  return rows.empty() ? prescribed : std::span<const char>(rows);
}
/// Forward dynamics of chains that are no trees of joints (`tree`), or have load-dependent friction.
template <class Elements, class State>
void accelerate_generally(const Elements& c, State& s, const tree::given_forces<typename State::scalar>& tau,
                          std::span<const char> prescribed, bool tree) {
  if (!s.tree().readers.empty())
    accelerate_with_friction(c, s, tau, prescribed, tree);
  else if (goes_by_clusters(s, prescribed))
    accelerate_clustered(c, s, tau);
  else
    accelerate_by_mass(c, s, tau, prescribed);
}
/// Forward dynamics under the forces tau(i) and those of the elements, written to `forces`: by articulated bodies in
/// trees, and in clusters where coordinates follow others; else by the mass matrix. `Elements` may have
/// `accelerate_generally` for chains that are no trees.
template <class Elements, class State>
void accelerations_on_coordinates(const Elements& c, State& s, const tree::given_forces<typename State::scalar>& tau,
                                  std::span<const char> prescribed) {
  if constexpr (requires { requires State::always_tree; }) {
    accelerate_after(s, articulate_under(c, s, tau, prescribed));
  } else {
    std::vector<char> rows;
    const std::span<const char> given = with_locked_rows(c, s, prescribed, rows);
    const bool tree = s.tree().plan.tree && !some_of_joint_prescribed(s, given);
    if (tree && s.tree().readers.empty()) [[likely]]
      accelerate_after(s, articulate_under(c, s, tau, given));
    else if constexpr (requires { c.accelerate_generally(s, tau, given, tree); })
      c.accelerate_generally(s, tau, given, tree);
    else
      accelerate_generally(c, s, tau, given, tree);
  }
}

}  // namespace kte::detail
