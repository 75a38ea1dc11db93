#pragma once

#include <kte/chain/steps.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/kernels/solve.hpp>

/// The algorithms as loops over elements, which do their steps (chain/steps.hpp) in the working memory of a state: on
/// runtime chains, and on static chains too large to unroll. `Elements` says
///   forward<Step>(s), backward<Step>(s)   a step of all elements that it concerns, in order, or from the last
///   down_from<Step>(e, s)                 of element e, of the one whose end is its base, and so on
///   reads_positions()                     whether forces of some depend on positions
/// A state comes with its coordinates, their sines and matrices, and its bases in place, and without forces.
namespace kte::detail {

/// f<K>(i) for all frames.
template <class State, class F>
void for_each_frame(State& s, const F& f) {
  for (int i = 0; i < static_cast<int>(s.work.frames.in_plane.size()); ++i) f.template operator()<kind::frame_2D>(i);
  for (int i = 0; i < static_cast<int>(s.work.frames.in_space.size()); ++i) f.template operator()<kind::frame_3D>(i);
}
/// The forces of elements that read positions, by the full passes; on coordinates, and on frames to be taken later.
template <class Elements, class State>
void push_from_positions(const Elements& e, State& s) {
  if (!e.reads_positions()) return;
  for_each_frame(s, [&s]<kind K>(int i) { clear_load(s.template get<K>(i)); });
  e.template forward<steps::move_fully>(s);
  e.template forward<steps::push_fully>(s);
}
template <class Elements, class State>
void take_forces_from_positions(const Elements& e, State& s) {
  if (!e.reads_positions()) return;
  for_each_frame(s, [&s]<kind K>(int i) {
    auto& load = s.work.frames.template get<K>(i).load;
    load = dense<typename State::scalar>(load + load_of(s.template get<K>(i)));
  });
}

/// Inverse dynamics (RNEA): the forces of virtual power on the coordinates, into the state.
template <class Elements, class State>
void forces_on_coordinates(const Elements& e, State& s) {
  push_from_positions(e, s);
  e.template forward<steps::move>(s);
  take_forces_from_positions(e, s);
  e.template backward<steps::push>(s);
}

/// The mass matrix (CRBA), into the working memory.
template <class Elements, class State>
void mass_of_coordinates(const Elements& e, State& s) {
  auto& w = s.work;
  auto& m = matrix_over_all(w);
  const bool followers = s.plan.coordinates > s.dofs();
  m.setZero();
  w.carried.fill({});
  if (followers) e.template forward<steps::follow>(s);
  e.template backward<steps::carry>(s);
  for (Eigen::Index j = 0; j < m.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i) m(i, j) = m(j, i) = m(i, j) + m(j, i);
  e.template backward<steps::carry_coordinate>(s);
  if (followers) w.mass = m.topLeftCorner(s.dofs(), s.dofs());
}

/// Clears what the articulated-body algorithm adds up.
template <class State>
void start_articulated(State& s) {
  auto& w = s.work;
  std::fill(w.own_mass.begin(), w.own_mass.end(), typename State::scalar(0));
  for (const auto& [k, i] : s.plan.bases) {
    const auto& x = w.frames.at(k, i);
    w.accelerations.at(k, i) = {x.acceleration, x.ang_acceleration};
    w.burdens.at(k, i) = {};
  }
  w.good = true;
}
template <class State>
void check_good(const State& s) {
  if (!s.work.good) [[unlikely]]
    raise_singular_mass_matrix();
}

/// The articulated-body algorithm (ABA): forces tau(i), and those of the elements, into accelerations in s.work.forces.
/// Throws `singular_mass_matrix`.
template <class Elements, class State, class Tau>
void accelerate_articulated(const Elements& e, State& s, const Tau& tau) {
  auto& w = s.work;
  push_from_positions(e, s);
  start_articulated(s);
  e.template forward<steps::move_by_rates>(s);
  take_forces_from_positions(e, s);
  read_listed_numbers<vector_of::f>(s, w.forces);
  for (int i = 0; i < s.dofs(); ++i) w.forces[i] += tau(i);
  e.template backward<steps::articulate>(s);
  e.template forward<steps::accelerate>(s);
  for (const int row : s.plan.lone_rows) {
    if (w.prescribed[static_cast<std::size_t>(row)]) {
      for_each_listed_freedom(s, [&](const auto& c, const freedom& at) {
        if (at.v == row) visit_a(c, [&](const auto& a) { w.forces[row] = a; });
      });
      continue;
    }
    const auto& m = w.own_mass[static_cast<std::size_t>(row)];
    w.good = w.good && all(m > typename State::scalar(0));
    w.forces[row] /= m;
  }
  check_good(s);
}

/// The inverse of the mass matrix after inertias have been articulated, with or without accelerations: by (1) of
/// local_inverse_mass.hpp.
template <class Elements, class State, class Matrix>
void invert_columns(const Elements& e, State& s, Matrix& inverse) {
  using S = typename State::scalar;
  auto& w = s.work;
  w.all_left.setZero();
  for (std::size_t joint = 0; joint < s.plan.places.size(); ++joint) {
    const place& at = s.plan.places[joint];
    if (!at.free) continue;
    for (int row = at.row; row < at.row + at.axes; ++row) {
      w.left.setZero(), w.rate.setZero();
      w.load = {}, w.unit = row;
      e.template down_from<steps::load_down>(static_cast<int>(joint), s);
      add_column(w.all_left, row, w.left, w.rate, inverse);
    }
  }
  for (const int row : s.plan.lone_rows) {
    inverse.col(row).setZero();
    inverse(row, row) = S(1) / w.own_mass[static_cast<std::size_t>(row)];
  }
}
/// The inverse of the mass matrix. Throws `singular_mass_matrix`.
template <class Elements, class State, class Matrix>
void invert_articulated(const Elements& e, State& s, Matrix& inverse) {
  using S = typename State::scalar;
  auto& w = s.work;
  for (const auto& [k, i] : s.plan.bases) w.frames.at(k, i) = {};
  std::fill(w.prescribed.begin(), w.prescribed.end(), 0);  // an earlier call may have left some
  start_articulated(s);
  w.forces.setZero();
  e.template forward<steps::rest>(s);
  e.template backward<steps::articulate>(s);
  for (const int row : s.plan.lone_rows) w.good = w.good && all(w.own_mass[static_cast<std::size_t>(row)] > S(0));
  check_good(s);
  invert_columns(e, s, inverse);
}

/// Derivatives of the forces on the coordinates, after `forces_on_coordinates`.
template <class Elements, class State, class Result>
void derive_forces(const Elements& e, State& s, Result& r) {
  auto& w = s.work;
  w.derivatives = &r;
  w.bodies.fill({});
  std::fill(w.row_of_axis.begin(), w.row_of_axis.end(), -1);
  r.by_q.setZero(), r.by_v.setZero(), r.by_a.setZero();
  e.template backward<steps::vary>(s);
  e.template forward<steps::vary_coordinates>(s);
}

}  // namespace kte::detail
