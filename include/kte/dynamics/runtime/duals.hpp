#pragma once

#include <kte/dynamics/looped/dual_derivatives.hpp>
#include <kte/dynamics/runtime/elements.hpp>
#include <kte/runtime_chain/derivative_state.hpp>

/// Derivatives of inverse dynamics of runtime chains by dual numbers, for forces between frames and for coordinates
/// that follow others. Templates, although for double only, so that they are compiled only if they are called.
namespace kte::detail {

/// The state with derivatives of a chain, in the memory of its state.
template <std::same_as<double> S, class State = basic_derivative_state<dual<S, derivative_number::variables>>>
State& state_with_derivatives(const runtime_chain& c, basic_runtime_state<S>& s) {
  const topology& t = c.wiring();
  const auto make = [&] { return State(t, s.shared_tree()); };
  auto& d = s.with_derivatives.template get<State>(make);
  if (d.layout() != t.layout) d = make();
  return d;
}
/// Copies all external quantities as constants, and q, v and a.
template <std::same_as<double> S, class D>
void take_given(basic_runtime_state<S>& s, basic_derivative_state<D>& d) {
  const auto take = [](auto& to, const auto& x) {
    set_motion(to, motion{x.position, x.rotation, x.velocity, x.ang_velocity, x.acceleration, x.ang_acceleration});
  };
  for (const auto& [k, i] : s.tree().plan.bases) {
    if (k == kind::frame_2D)
      take(d.template get<kind::frame_2D>(i), spatial(s.template get<kind::frame_2D>(i)));
    else
      take(d.template get<kind::frame_3D>(i), s.template get<kind::frame_3D>(i));
  }
  const auto& row = s.tree().plan.row_of_gen;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] < s.dofs()) continue;
    const auto& from = s.template get<kind::gen>(static_cast<int>(i));
    auto& to = d.template get<kind::gen>(static_cast<int>(i));
    to.q = from.q, to.q_dot = from.q_dot, to.q_ddot = from.q_ddot;
  }
  const auto& t = *s.made_for();
  for (const auto& x : t.signals) {
    if (x.what == kind::vector)
      d.template get<kind::vector>(x.slot) = as<D>(s.template get<kind::vector>(x.slot));
    else
      d.template get<kind::input>(x.slot) = s.template get<kind::input>(x.slot);
  }
  for (int i = 0; i < t.count(kind::internal); ++i)
    d.template get<kind::internal>(i).z = s.template get<kind::internal>(i).z;
  read_listed_numbers<vector_of::q>(s, d.q), read_listed_numbers<vector_of::v>(s, d.v);
  read_listed_numbers<vector_of::a>(s, d.a);
}

/// Displacements of joints along their axes, in body axes, and their rates. Rotations and poses, which are always free,
/// move along `moving`.
template <class D>
void take_shifts(basic_derivative_state<D>& d, const directions& moving) {
  auto& w = d.work;
  const auto& f = d.tree().body_tree;
  for (const auto& r : f.nodes) {
    const auto first = static_cast<std::size_t>(r.first);
    if (r.is_number())
      w.shift[first] = {0.0, d.template get<kind::gen>(r.slot).q.derivative};
    else if (r.moves == tree::joint::varying)
      each_number(d, r, [&w](const auto& c, std::size_t k) { w.shift[k] = {0.0, c.q.derivative}; });
    else
      for (auto k = first; k < first + static_cast<std::size_t>(r.axes); ++k) {
        w.shift[k] = D(0);
        if (const int lane = moving.lane(f.row[k]); moving.by == vector_of::q && lane >= 0 && lane < D::variables)
          w.shift[k].derivative[static_cast<std::size_t>(lane)] = 1;
      }
    each_axis<vector_of::v>(d, r, [&w](const D& x, std::size_t k) { w.rate[k] = x; });
    each_axis<vector_of::a>(d, r, [&w](const D& x, std::size_t k) { w.acceleration[k] = x; });
  }
}
/// Copies q, v, a of the state with derivatives to its coordinates.
template <class D>
void put_coordinates(basic_derivative_state<D>& d) {
  for_each_listed_freedom(d, [&d](auto& x, const freedom& at) {
    put<vector_of::q>(x, at, d.q), put<vector_of::v>(x, at, d.v), put<vector_of::a>(x, at, d.a);
  });
}
/// No loads on bodies and coordinates but those of elements.
struct no_more_loads {
  template <class D>
  void operator()(const basic_derivative_state<D>&) const {}
};
/// Inverse dynamics at q, v, a of the state with derivatives, whose bases are set. Writes the generalized forces to its
/// `forces`. more(d), when bodies have moved, may add `loads` of bodies and forces on coordinates.
template <class Elements, std::same_as<double> S, class D, class More = no_more_loads>
void inverse_dynamics_in_duals(const Elements& elements, const basic_runtime_state<S>& s, basic_derivative_state<D>& d,
                               const directions& moving, const More& more = {}) {
  const auto& t = s.tree();
  put_coordinates(d);
  bring_up_to_date(elements, d);
  take_shifts(d, moving);
  clear_coordinates(d);
  for (const auto& [coordinate, mass] : t.rotors) {
    auto& x = d.template get<kind::gen>(coordinate);
    x.f -= mass * x.q_ddot;
  }
  tree::move_in_duals(t.body_tree, s.work, d.work);
  if (!t.on_frames.empty() || !t.late.empty()) {
    place_touched_frames(d, true);
    move_late(elements, d);
    for (auto e = t.on_frames.rbegin(); e != t.on_frames.rend(); ++e) elements.push(*e, d);
    take_frame_loads(d);
  } else if constexpr (!std::is_same_v<More, no_more_loads>) {
    std::fill(d.work.loads.begin(), d.work.loads.end(), tree::dense_wrench<D>{});
  }
  more(d);
  tree::transmit_in_duals(t.body_tree, s.work, d.work);
  for (const auto& r : t.body_tree.nodes)
    each_axis<vector_of::f>(d, r, [&d](auto& f, std::size_t k) { f -= d.work.force[k]; });
  for_each_friction(elements, d, [&d](const auto& r, const D& friction) {
    auto& x = d.template get<kind::gen>(r.slot);
    x.f = x.f + friction;
  });
  push_on_coordinates(elements, d, acting::all);
  read_listed_numbers<vector_of::f>(d, d.forces);
  for (auto& f : d.forces) f = -f;
}

/// Places joints with varying axes with the second derivatives of their axes, for `inverse_dynamics_in_duals`.
template <std::same_as<double> S>
void place_second_axes(const runtime_chain& c, basic_runtime_state<S>& s) {
  for (const int i : s.tree().body_tree.varying)
    place_varying(runtime_elements{c}, s, s.tree().body_tree.nodes[static_cast<std::size_t>(i)],
                  s.work.joint_transforms[static_cast<std::size_t>(i)], true);
}
/// The state with derivatives, with everything that `inverse_dynamics_in_duals` needs but directions. Call inverse
/// dynamics first.
template <std::same_as<double> S>
auto& state_in_duals(const runtime_chain& c, basic_runtime_state<S>& s) {
  auto& d = state_with_derivatives(c, s);
  take_given(s, d);
  take_bases(s), place_in_world(s), place_second_axes(c, s);
  tree::place_bases_in_duals(s.tree().body_tree, s.work, d.work);
  return d;
}
/// Derivatives by q and v at the state, written to `of_forces`; call inverse dynamics first. by_a is the mass matrix,
/// minus the derivatives of load-dependent friction.
template <std::same_as<double> S>
void derive_forces_by_duals(const runtime_chain& c, basic_runtime_state<S>& s) {
  auto& r = s.work.of_forces;
  const Eigen::Index n = s.dofs();
  r.tau.resize(n), r.by_q.setZero(n, n), r.by_v.setZero(n, n), r.by_a.setZero(n, n);
  const bool load_dependent = !s.tree().readers.empty();
  auto& d = state_in_duals(c, s);
  derive_by_duals(
      s.freedoms(), std::span(d.q), std::span(d.v), std::span(d.a), load_dependent,
      [&](const directions& moving) -> const auto& {
        inverse_dynamics_in_duals(runtime_elements{c}, s, d, moving);
        return d.forces;
      },
      r);
  if (load_dependent) return;
  mass_of_coordinates(runtime_elements{c}, s);
  r.by_a = s.work.mass;
}

}  // namespace kte::detail

#ifdef KTE_EXTERN
namespace kte::tree {
KTE_EXTERN template void move_in_duals(const body_tree<double>&, const memory<double, double>&,
                                       dual_memory<detail::derivative_number>&);
KTE_EXTERN template void transmit_in_duals(const body_tree<double>&, const memory<double, double>&,
                                           dual_memory<detail::derivative_number>&);
}  // namespace kte::tree
#endif
