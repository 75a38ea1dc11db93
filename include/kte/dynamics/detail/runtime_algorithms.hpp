#pragma once

#include <kte/dynamics/detail/runtime_loops.hpp>
#include <kte/kernels/solve.hpp>

#include <algorithm>
#include <utility>

/// The algorithms on runtime chains, as loops over records.
namespace kte {

namespace detail {

inline void check_masses(const runtime_state& s, const Eigen::MatrixXd& m) {
  if (!all_finite(m.data(), static_cast<std::size_t>(m.size()))) [[unlikely]]
    blame_mass(s, first_endless(m), false);
}
/// Where an axis has nothing to move, or more than a number can say.
[[noreturn, gnu::cold]] inline void blame_axis(const runtime_state& s, int axis) {
  const double inverse = s.work.answers[static_cast<std::size_t>(axis)].inverse;
  blame_mass(s, s.tree().forest.row[static_cast<std::size_t>(axis)], inverse == inverse && inverse != 0);
}

/// The change of what a follower writes by a coordinate that it follows: of q_dot, when that has a rate of one.
inline double ratio_of(const kte_map_chain& c, runtime_state& s, int follower, gen_coord<>& followed) {
  const auto& e = connection_of(c, follower);
  auto& end = s.get<kind::gen>(e.index.back());
  const gen_coord<> before = followed, end_before = end;
  const auto rate_at = [&](double rate) {
    followed.q_dot = rate;
    e.element->doMotion(s);
    return end.q_dot;
  };
  const double at_rest = rate_at(0), ratio = rate_at(1) - at_rest;
  followed = before, end = end_before;
  return ratio;
}
/// Rows and columns of followers count for what they follow too, from the last: x_b += ratio x_e.
template <class Add>
void hand_on(const kte_map_chain& c, runtime_state& s, const Add& add) {
  const auto& t = s.tree();
  for (auto f = t.followers.rbegin(); f != t.followers.rend(); ++f) {
    const auto& e = connection_of(c, *f);
    const int end = t.plan.row_of_gen[static_cast<std::size_t>(e.index.back())];
    for (std::size_t p = 0; p + 1 < e.index.size(); ++p)
      if (e.ports[p].what == kind::gen)
        add(t.plan.row_of_gen[static_cast<std::size_t>(e.index[p])], end,
            ratio_of(c, s, *f, s.get<kind::gen>(e.index[p])));
  }
}

/// The inertias of bodies with all they carry, and axes, in the world.
inline void carry(const kte_map_chain& c, runtime_state& s) {
  place_bodies(c, s);
  place_in_world(s);
  tree::carry_bodies(s.tree().forest, s.work);
}
/// The mass matrix, into the working memory.
inline void mass_of_coordinates(const kte_map_chain& c, runtime_state& s) {
  carry(c, s);
  const auto& t = s.tree();
  const auto& row = t.forest.row;
  auto& w = s.work;
  const bool others = t.plan.coordinates > s.dofs();
  auto& m = others ? w.all : w.mass;
  m.setZero(t.plan.coordinates, t.plan.coordinates);
  double* const data = m.data();
  const Eigen::Index n = m.rows();
  tree::masses(t.forest, w, [&, once = t.plan.tree](int j, int k, double x) {
    const int a = row[static_cast<std::size_t>(j)], b = row[static_cast<std::size_t>(k)];
    if (once) [[likely]] {
      data[b * n + a] = data[a * n + b] = x;
    } else {  // where joints share a coordinate, both triangles meet on the diagonal
      data[b * n + a] += x;
      if (j != k) data[a * n + b] += x;
    }
  });
  if (t.has_own_mass)
    for (int i = 0; i < t.plan.coordinates; ++i) m(i, i) += t.own_mass[static_cast<std::size_t>(i)];
  if (!others) return;
  hand_on(c, s, [&m](int base, int end, double ratio) {
    m.row(base) += ratio * m.row(end);
    m.col(base) += ratio * m.col(end);
  });
  w.mass = m.topLeftCorner(s.dofs(), s.dofs());
}

/// By the factorised mass matrix.
template <class Tau>
void accelerate_by_mass(const kte_map_chain& c, runtime_state& s, const Tau& tau) {
  for_each_listed_freedom(s, [](auto& x, const freedom&) { visit_a(x, [](double& a) { a = 0; }); });
  coordinate_forces(c, s);
  auto& a = s.work.forces;
  read_listed_numbers<vector_of::f>(s, a);
  for (int i = 0; i < s.dofs(); ++i) a[i] += tau(i);
  mass_of_coordinates(c, s);
  solve_in_place(s.work.mass, a, [&s](int row) { blame_mass(s, row, true); });
}

/// The forces that elements put on coordinates and frames for the rates alone: into `forces` by row, and into the loads
/// of articulated bodies.
inline void push_by_rates(const kte_map_chain& c, runtime_state& s) {
  const auto& t = s.tree();
  auto& w = s.work;
  clear_coordinates(s);
  for (const auto& r : t.forest.records)
    if (w.yields[static_cast<std::size_t>(&r - t.forest.records.data())])
      each_axis<vector_of::a>(s, r, [](double& x, std::size_t) { x = 0; });
  for (const int row : t.plan.lone_rows)
    if (!w.prescribed[static_cast<std::size_t>(row)])
      for_each_listed_freedom(s, [row](auto& x, const freedom& at) {
        if (at.v == row) visit_a(x, [](double& a) { a = 0; });
      });
  if (!t.on_frames.empty()) {
    std::fill(w.acceleration.begin(), w.acceleration.end(), 0.0);
    tree::move_bodies<true>(t.forest, w);
    place_in_world(s);
    place_touched_frames(s, false);
    for (const int e : t.on_frames) element_of(c, e).doForce(s);
    for_each_frame_load(s, [&w](std::size_t slot, const tree::dense_wrench<double>& x) {
      auto& load = w.articulated[slot].load;
      load = {load.force + x.force, load.torque + x.torque};
    });
  }
  for (auto e = t.on_coordinates.rbegin(); e != t.on_coordinates.rend(); ++e) element_of(c, *e).doForce(s);
}
/// By articulated bodies, in trees. Accelerations of rows that are `prescribed` are those of the state.
template <class Tau>
void accelerate_articulated(const kte_map_chain& c, runtime_state& s, const Tau& tau,
                            std::span<const char> prescribed) {
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
    w.force[k] = t.forest.row[k] < s.dofs() ? w.forces[t.forest.row[k]] : 0;
  if (const int bad = tree::articulate(t.forest, w); bad >= 0) [[unlikely]]
    blame_axis(s, bad);
  if (!t.on_frames.empty()) take_rates(s);  // accelerations of what does not yield
  tree::accelerate(t.forest, w);
  for (std::size_t k = 0; k < t.forest.row.size(); ++k)
    if (t.forest.row[k] < s.dofs()) w.forces[t.forest.row[k]] = w.acceleration[k];
  for (const int row : t.plan.lone_rows) {
    if (w.prescribed[static_cast<std::size_t>(row)]) {
      for_each_listed_freedom(s, [&](const auto& x, const freedom& at) {
        if (at.v == row) visit_a(x, [&](const auto& a) { w.forces[row] = a; });
      });
      continue;
    }
    const double m = t.own_mass[static_cast<std::size_t>(row)];
    if (!(m > 0)) [[unlikely]]
      blame_mass(s, row, true);
    w.forces[row] /= m;
  }
}
/// At positions that are good. Some accelerations may be given, in the state: those of rows that are `prescribed`, in
/// trees.
template <class Tau>
const Eigen::VectorXd& accelerations_under(const kte_map_chain& c, runtime_state& s, const Tau& applied,
                                           std::span<const char> prescribed = {}) {
  auto& kept = s.work.kept;  // what is applied may be a result that the state holds
  for (int i = 0; i < s.dofs(); ++i) kept[static_cast<std::size_t>(i)] = applied(i);
  const auto tau = [&kept](int i) { return kept[static_cast<std::size_t>(i)]; };
  if (s.tree().plan.tree)
    accelerate_articulated(c, s, tau, prescribed);
  else
    accelerate_by_mass(c, s, tau);
  check_result(s.work.forces, static_cast<std::size_t>(s.dofs()),
               [&] { blame("an acceleration", s, Eigen::Map<const Eigen::VectorXd>(kept.data(), s.dofs())); });
  write_numbers<vector_of::a>(s, s.work.forces, "a");
  return s.work.forces;
}

struct runtime_frame {
  kind what;
  int index;
};
inline runtime_frame find_frame(const kte_map_chain& c, const name_or_handle& frame) {
  const auto [k, index] = frame.frame_of(c.wiring());
  return {k, index};
}
/// doMotion of an element, after that of all that it depends on, each once.
inline void move_element(const topology& t, runtime_state& s, int element) {
  const auto at = [](auto& x, int e) -> auto& { return x[static_cast<std::size_t>(e)]; };
  auto& wanted = s.work.wanted;
  at(wanted, element) = 1;
  int first = element;
  for (int e = element; e >= first; --e) {
    if (!at(wanted, e)) continue;
    const auto& c = at(t.elements, e);
    for (std::size_t p = 0; p < c.ports.size(); ++p) {
      if (c.ports[p].writes() || is_signal(c.ports[p].what)) continue;
      const int writer = at(t.writers[static_cast<std::size_t>(c.ports[p].what)], c.index[p]);
      if (writer >= 0) at(wanted, writer) = 1, first = std::min(first, writer);
    }
  }
  for (int e = first; e <= element; ++e)
    if (std::exchange(at(wanted, e), 0)) at(t.elements, e).element->doMotion(s);
}
/// The same for a frame: what writes it, if an element does.
inline void move(const topology& t, runtime_state& s, const runtime_frame& x) {
  const int writer = t.writers[static_cast<std::size_t>(x.what)][static_cast<std::size_t>(x.index)];
  if (writer >= 0) move_element(t, s, writer);
}

}  // namespace detail

}  // namespace kte
