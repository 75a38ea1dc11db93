#pragma once

#include <kte/dynamics/detail/rare_shapes.hpp>
#include <kte/kernels/invert_general.hpp>
#include <kte/kernels/solve.hpp>
#include <kte/tree/fill_symmetric.hpp>

#include <span>

/// The algorithms as loops over records, in the working memory of a state, which has its coordinates and bases and is
/// found good. For all `Elements` and states of dynamics/detail/record_loops.hpp.
namespace kte::detail {

/// The change of what a follower writes by a coordinate that it follows: of q_dot, when that has a rate of one.
template <class Elements, class State, class Coordinate>
auto ratio_of(const Elements& c, State& s, int follower, Coordinate& followed) {
  using S = typename State::scalar;
  auto& end = s.template get<kind::gen>(c.written(follower));
  const Coordinate before = followed, end_before = end;
  const auto rate_at = [&](const S& rate) -> S {
    followed.q_dot = rate;
    c.move(follower, s);
    return end.q_dot;
  };
  const S at_rest = rate_at(S(0)), ratio = rate_at(S(1)) - at_rest;
  followed = before, end = end_before;
  return ratio;
}
/// visit(follower, port, row of what it follows there, row of what it writes), from the last follower; of two ports
/// that lead to one coordinate for the first, as rates by a coordinate have both.
template <class Elements, class State, class Visit>
void for_each_followed(const Elements& c, const State& s, const Visit& visit) {
  const auto& t = s.tree();
  for (auto f = t.followers.rbegin(); f != t.followers.rend(); ++f) {
    const auto ports = c.ports(*f);
    if (ports.back().what != kind::gen) continue;
    const auto row = [&t](int coordinate) { return t.plan.row_of_gen[static_cast<std::size_t>(coordinate)]; };
    for (std::size_t p = 0; p + 1 < ports.size(); ++p) {
      bool first = ports[p].what == kind::gen;
      for (std::size_t before = 0; before < p; ++before)
        first &= ports[before].what != kind::gen || c.index(*f, before) != c.index(*f, p);
      if (first) visit(*f, p, row(c.index(*f, p)), row(c.written(*f)));
    }
  }
}
/// Rows and columns of followers count for what they follow too, from the last: x_b += ratio x_e.
template <class Elements, class State, class Add>
void hand_on(const Elements& c, State& s, const Add& add) {
  for_each_followed(c, s, [&](int follower, std::size_t port, int to, int from) {
    add(to, from, ratio_of(c, s, follower, s.template get<kind::gen>(c.index(follower, port))));
  });
}

/// The mass matrix (CRBA), into the working memory.
template <class Elements, class State>
void mass_of_coordinates(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  place_bodies(c, s);
  tree::carry_bodies(t.forest, w, false);
  const bool others = t.plan.coordinates > s.dofs();
  auto& m = others ? w.all : w.mass;
  tree::masses(t.forest, w, w.masses.wrenches, w.masses.rows);
  tree::fill_symmetric(t.forest, t.plan.coordinates, w.masses.rows, false, m);
  if (t.has_own_mass)
    for (int i = 0; i < t.plan.coordinates; ++i) m(i, i) += t.own_mass[static_cast<std::size_t>(i)];
  if (others) {
    hand_on(c, s, [&m](int to, int from, const S& ratio) {
      m.row(to) += ratio * m.row(from);
      m.col(to) += ratio * m.col(from);
    });
    w.mass = m.topLeftCorner(s.dofs(), s.dofs());
  }
  if (!t.spread.empty()) add_spread_masses(c, s, w.mass);
}

/// The forces that elements put on coordinates and frames for the rates alone: into `forces` by row, and into the loads
/// of articulated bodies.
template <class Elements, class State>
void push_by_rates(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  clear_coordinates(s);
  for (std::size_t i = 0; i < t.forest.records.size(); ++i)
    if (w.yields[i]) each_axis<vector_of::a>(s, t.forest.records[i], [](S& x, std::size_t) { x = S(0); });
  for (const int row : t.plan.lone_rows)
    if (!w.prescribed[static_cast<std::size_t>(row)])
      for_each_listed_freedom(s, [row](auto& x, const freedom& at) {
        if (at.v == row) visit_a(x, [](S& a) { a = S(0); });
      });
  if (!t.on_frames.empty() || !t.late.empty()) {
    std::fill(w.acceleration.begin(), w.acceleration.end(), S(0));
    tree::move_bodies<true>(t.forest, w);
    place_in_world(s);
    place_touched_frames(s, false);
    move_late(c, s);
    for (auto e = t.on_frames.rbegin(); e != t.on_frames.rend(); ++e) c.push(*e, s);
    for_each_frame_load(s, [&w](std::size_t slot, const tree::dense_wrench<S>& x) {
      auto& load = w.articulated[slot].load;
      load = {load.force + x.force, load.torque + x.torque};
    });
  }
  for (auto e = t.on_coordinates.rbegin(); e != t.on_coordinates.rend(); ++e) c.push(*e, s);
}
/// Where an axis has nothing to move, or more than a number can say.
template <class Elements, class State>
[[noreturn, gnu::cold]] void blame_axis(const Elements& c, const State& s, int axis) {
  const auto& inverse = s.work.answers[static_cast<std::size_t>(axis)].inverse;
  c.blame_mass(s, s.tree().forest.row[static_cast<std::size_t>(axis)],
               all(inverse == inverse) && !all(inverse == typename State::scalar(0)));
}
/// Masses of coordinates that move no joint.
template <class Elements, class State>
void check_lone_masses(const Elements& c, const State& s) {
  for (const int row : s.tree().plan.lone_rows)
    if (!s.work.prescribed[static_cast<std::size_t>(row)] && !(s.tree().own_mass[static_cast<std::size_t>(row)] > 0))
        [[unlikely]]
      c.blame_mass(s, row, true);
}
/// Forces tau(i), and those of the elements, to accelerations in `forces`, by articulated bodies (ABA): in trees.
/// Accelerations of rows that are `prescribed` are those of the state.
template <class Elements, class State, class Tau>
void accelerate_articulated(const Elements& c, State& s, const Tau& tau, std::span<const char> prescribed) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  std::fill(w.prescribed.begin(), w.prescribed.end(), 0);
  std::copy(prescribed.begin(), prescribed.end(), w.prescribed.begin());
  place_bodies(c, s);
  take_rates(s), take_bases(s);
  for (std::size_t i = 0; i < t.forest.records.size(); ++i) {
    const auto& r = t.forest.records[i];
    const int row = t.forest.row[static_cast<std::size_t>(r.first)];
    w.yields[i] = r.yields && !w.prescribed[static_cast<std::size_t>(row)];
  }
  tree::start_articulated(t.forest, w, true);
  if (t.on_coordinates.empty() && t.on_frames.empty()) {
    for (int i = 0; i < s.dofs(); ++i) w.forces[i] = tau(i);
  } else {
    push_by_rates(c, s);
    read_listed_numbers<vector_of::f>(s, w.forces);
    for (int i = 0; i < s.dofs(); ++i) w.forces[i] += tau(i);
  }
  for (std::size_t k = 0; k < t.forest.row.size(); ++k)
    w.force[k] = t.forest.row[k] < s.dofs() ? w.forces[t.forest.row[k]] : S(0);
  if (const int bad = tree::articulate(t.forest, w); bad >= 0) [[unlikely]]
    blame_axis(c, s, bad);
  if (!t.on_frames.empty() || !t.late.empty()) take_rates(s);  // accelerations of what does not yield
  tree::accelerate(t.forest, w);
  for (std::size_t k = 0; k < t.forest.row.size(); ++k)
    if (t.forest.row[k] < s.dofs()) w.forces[t.forest.row[k]] = w.acceleration[k];
  if (t.plan.lone_rows.empty()) return;
  check_lone_masses(c, s);
  for (const int row : t.plan.lone_rows) {
    if (!w.prescribed[static_cast<std::size_t>(row)]) {
      w.forces[row] /= t.own_mass[static_cast<std::size_t>(row)];
      continue;
    }
    for_each_listed_freedom(s, [&](const auto& x, const freedom& at) {
      if (at.v == row) visit_a(x, [&](const auto& a) { w.forces[row] = a; });
    });
  }
}

/// The same of any chain by its mass matrix, factorised.
template <class Elements, class State, class Tau>
void accelerate_by_mass(const Elements& c, State& s, const Tau& tau, std::span<const char> prescribed) {
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
  const auto fail = [&](int row) { c.blame_mass(s, row, true); };
  if (prescribed.empty()) return solve_in_place(s.work.mass, a, fail);
  for_each_listed_freedom(s, [&](auto& x, const freedom& at) { put<vector_of::a>(x, at, given); });
  for (int i = 0; i < n; ++i)
    if (prescribed[static_cast<std::size_t>(i)]) a[i] = given[i];
  solve_partly_known(s.work.mass, a, prescribed, fail);
}
/// By articulated bodies in trees, else by the mass matrix; with friction by what joints carry.
template <class Elements, class State, class Tau>
void accelerate_with_friction(const Elements& c, State& s, const Tau& tau, std::span<const char> prescribed) {
  using S = typename State::scalar;
  const bool tree = s.tree().plan.tree;
  const auto& readers = s.tree().readers;
  if (readers.empty()) [[likely]]
    return tree ? accelerate_articulated(c, s, tau, prescribed) : accelerate_by_mass(c, s, tau, prescribed);
  Eigen::Matrix<S, Eigen::Dynamic, 1> all(s.dofs()), given(s.dofs());
  read_listed_numbers<vector_of::a>(s, given);
  iterate_friction(c, s, [&] {
    for_each_listed_freedom(s, [&](auto& x, const freedom& at) { put<vector_of::a>(x, at, given); });
    for (int i = 0; i < s.dofs(); ++i) all[i] = tau(i);
    for (std::size_t k = 0; tree && k < readers.size(); ++k)  // of others M needs it on all coordinates, at once
      if (const int row = s.tree().plan.joint_row[static_cast<std::size_t>(readers[k])]; row < s.dofs())
        all[row] += s.work.friction[k];
    const auto applied = [&all](int i) { return all[i]; };
    tree ? accelerate_articulated(c, s, applied, prescribed) : accelerate_by_mass(c, s, applied, prescribed);
    for_each_listed_freedom(s, [&](auto& x, const freedom& at) { put<vector_of::a>(x, at, s.work.forces); });
  });
}

/// visit(element, row of the coordinate that it holds).
template <class Elements, class State, class Visit>
void for_each_held(const Elements& c, State& s, const Visit& visit) {
  for (const int e : s.tree().holders)
    if (c.holds(e, s)) visit(e, s.tree().plan.row_of_gen[static_cast<std::size_t>(c.index(e, 0))]);
}
/// The same, with coordinates that elements hold: those have no acceleration.
template <class Elements, class State, class Tau>
void accelerate_by_records(const Elements& c, State& s, const Tau& tau, std::span<const char> prescribed) {
  std::vector<char> rows;
  for_each_held(c, s, [&](int e, int row) {
    if (rows.empty()) {
      rows.assign(prescribed.begin(), prescribed.end());
      rows.resize(static_cast<std::size_t>(s.dofs()));
    }
    char& is_prescribed = rows[static_cast<std::size_t>(row)];
    if (!is_prescribed) s.template get<kind::gen>(c.index(e, 0)).q_ddot = typename State::scalar(0);
    is_prescribed = 1;
  });
  accelerate_with_friction(c, s, tau, rows.empty() ? prescribed : std::span<const char>(rows));
}
/// How accelerations answer forces where coordinates are held: the inverse of the other rows of M, else zeros.
template <class Elements, class State, class Matrix>
void invert_unheld(const Elements& c, State& s, Matrix& inverse) {
  using S = typename State::scalar;
  mass_of_coordinates(c, s);
  auto& m = s.work.mass;
  for_each_held(c, s, [&m](int, int row) {
    m.row(row).setZero(), m.col(row).setZero();
    m(row, row) = S(1);
  });
  inverse.resize(s.dofs(), s.dofs());
  invert_by_factors(m, inverse, [&](int row) { c.blame_mass(s, row, true); });
  for_each_held(c, s, [&inverse](int, int row) { inverse(row, row) = S(0); });
}

/// The same where friction depends on what joints carry: by dtau/da, which is not symmetric.
template <class Elements, class State, class Matrix>
void invert_unheld_rubbing(const Elements& c, State& s, const Matrix& by_a, Matrix& inverse) {
  using S = typename State::scalar;
  Matrix m = by_a;
  for_each_held(c, s, [&m](int, int row) {
    m.row(row).setZero(), m.col(row).setZero();
    m(row, row) = S(1);
  });
  if (!invert_general(m, inverse)) [[unlikely]]
    raise<no_solution>(
        "kte: accelerations do not follow smoothly from forces: friction of joints by what they carry is "
        "about to jam");
  for_each_held(c, s, [&inverse](int, int row) { inverse(row, row) = S(0); });
}

/// The inverse of the mass matrix of a tree, after articulated inertias, whose loads are used up.
template <class State, class Matrix>
void invert_articulated(State& s, Matrix& inverse) {
  using S = typename State::scalar;
  const auto& f = s.tree().forest;
  auto& w = s.work;
  tree::inverse_masses(f, w, w.masses);
  tree::fill_symmetric(f, s.dofs(), w.masses.rows, true, inverse);
  for (const int row : s.tree().plan.lone_rows)
    inverse(row, row) = S(1) / s.tree().own_mass[static_cast<std::size_t>(row)];
}
/// The same of a tree at rest.
template <class Elements, class State, class Matrix>
void articulate_and_invert(const Elements& c, State& s, Matrix& inverse) {
  using S = typename State::scalar;
  const auto& t = s.tree();
  auto& w = s.work;
  place_bodies(c, s);
  for (std::size_t i = 0; i < t.forest.records.size(); ++i) w.yields[i] = t.forest.records[i].yields;
  std::fill(w.force.begin(), w.force.end(), S(0));
  std::fill(w.prescribed.begin(), w.prescribed.end(), 0);
  tree::start_articulated(t.forest, w, false);
  if (const int bad = tree::articulate(t.forest, w); bad >= 0) [[unlikely]]
    blame_axis(c, s, bad);
  check_lone_masses(c, s);
  invert_articulated(s, inverse);
}

/// Derivatives of what must be applied, after `forces_on_coordinates`: into `of_forces`, but for tau.
template <class Elements, class State>
void derive_forces(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& f = s.tree().forest;
  auto& w = s.work;
  auto& r = w.of_forces;
  const Eigen::Index n = s.dofs();
  // Of bodies alone the same entries are written each time: the others stay zero.
  if (!s.tree().only_bodies || r.by_a.rows() != n) r.by_q.setZero(n, n), r.by_v.setZero(n, n), r.by_a.setZero(n, n);
  w.variations.axes.resize(f.axes()), w.variations.bodies.resize(f.slots());
  place_in_world(s);
  tree::start_variations(f, w, w.variations);
  S *const q = r.by_q.data(), *const v = r.by_v.data(), *const a = r.by_a.data();
  const int* const row = f.row.data();
  const bool by_axes = f.in_order && static_cast<Eigen::Index>(f.axes()) == n;
  tree::vary_forces(f, w, w.variations,
                    [=](int j, int k, const S& by_q, const S& by_v, const S& by_a) KTE_INLINE_LAMBDA {
                      Eigen::Index at = k * n + j;
                      if (!by_axes) {
                        if (row[j] >= n || row[k] >= n) return;  // a coordinate that is given
                        at = row[k] * n + row[j];
                      }
                      q[at] = by_q, v[at] = by_v, a[at] = by_a;
                    });
  for (const auto& [coordinate, mass] : s.tree().rotors)
    if (const int at = s.tree().plan.row_of_gen[static_cast<std::size_t>(coordinate)]; at < n) r.by_a(at, at) += mass;
  for (const int e : s.tree().on_coordinates) c.derive(e, s);
}

}  // namespace kte::detail
