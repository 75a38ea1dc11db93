#pragma once

#include <kte/chain/kte_map_chain.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>

/// The algorithms on runtime chains, under the names they have on static chains. They work in the memory of a state and
/// return references into it, valid until the next call with that state; they allocate nothing.
namespace kte {

namespace detail {

template <indexable V>
void set_coordinates(runtime_state& s, const V& v, double gen_coord<>::*member, const char* name) {
  check_size(static_cast<std::size_t>(s.dofs()), v, name);
  for (int i = 0; i < s.dofs(); ++i) s.coordinate(i).*member = v[static_cast<std::size_t>(i)];
}

inline void check_positions(const runtime_state& s) {
  for (int i = 0; i < s.dofs(); ++i)
    if (!(s.coordinate(i).q - s.coordinate(i).q == 0)) throw bad_argument("kte: a coordinate is no finite number");
}

inline void evaluate(const kte_map_chain& c, runtime_state& s) {
  c.doMotion(s);
  c.clearForce(s);
  c.doForce(s);
}

/// doMotion of all elements that a thing depends on.
inline void move(const topology& t, runtime_state& s, kind k, int index) {
  const int w = t.writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(index)];
  if (w < 0) return;
  const auto& e = t.elements[static_cast<std::size_t>(w)];
  const auto ports = e.element->ports();
  for (std::size_t p = 0; p < ports.size(); ++p)
    if (!ports[p].writes() && ports[p].what != kind::input) move(t, s, ports[p].what, e.index[p]);
  e.element->doMotion(s);
}

/// The mass matrix over all coordinates, into s.work.all (CRBA).
inline void mass_of_coordinates(const topology& t, runtime_state& s) {
  auto& m = s.work.all;
  m.setZero();
  for (auto& frames : s.work.carried)
    for (auto& c : frames) c = {};
  for (const auto& e : t.elements) e.element->update_coordinates(s);
  for (auto e = t.elements.rbegin(); e != t.elements.rend(); ++e) e->element->carry(s);
  for (const auto& joint : t.elements) {
    if (joint.coordinate < 0) continue;
    wrench_3D w;
    m(joint.coordinate, joint.coordinate) += joint.element->start_column(s, w);
    joint.element->carry_wrench(s, w);
    for (int below = joint.below; below >= 0;) {
      const auto& e = t.elements[static_cast<std::size_t>(below)];
      if (!e.stiff) throw bad_argument("kte: the mass matrix needs joints and links, not " + e.element->record().type);
      const double f = e.element->carry_wrench(s, w);
      if (e.coordinate >= 0) m(e.coordinate, joint.coordinate) += f, m(joint.coordinate, e.coordinate) += f;
      below = e.below;
    }
  }
  for (auto e = t.elements.rbegin(); e != t.elements.rend(); ++e) e->element->coordinate_mass(s);
}

}  // namespace detail

/// Inverse dynamics by the passes (RNEA) at the state's positions, rates and accelerations. As `inverse_dynamics` on a
/// static chain.
inline const Eigen::VectorXd& inverse_dynamics(const kte_map_chain& c, runtime_state& s) {
  detail::evaluate(c, s);
  for (int i = 0; i < s.dofs(); ++i) s.work.forces[i] = -s.coordinate(i).f;
  detail::check_finite(s.work.forces, static_cast<std::size_t>(s.dofs()),
                       "kte: a force is no finite number: an argument is none, or is too large");
  return s.work.forces;
}
/// The same at q, v, a, which are put into the state.
template <indexable Q, indexable V, indexable A>
const Eigen::VectorXd& inverse_dynamics(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v, const A& a) {
  detail::set_coordinates(s, q, &gen_coord<>::q, "q");
  detail::set_coordinates(s, v, &gen_coord<>::q_dot, "v");
  detail::set_coordinates(s, a, &gen_coord<>::q_ddot, "a");
  return inverse_dynamics(c, s);
}

/// The mass matrix at the state's positions (CRBA). As `mass_matrix` on a static chain.
inline const Eigen::MatrixXd& mass_matrix(const kte_map_chain& c, runtime_state& s) {
  c.check(s);
  const auto& t = c.wiring();
  detail::check_positions(s);
  detail::mass_of_coordinates(t, s);
  for (int i = 0; i < s.dofs(); ++i)
    for (int j = 0; j < s.dofs(); ++j)
      s.work.mass(i, j) = s.work.all(t.dofs[static_cast<std::size_t>(i)], t.dofs[static_cast<std::size_t>(j)]);
  return s.work.mass;
}
/// The same at q, which is put into the state.
template <indexable Q>
const Eigen::MatrixXd& mass_matrix(const kte_map_chain& c, runtime_state& s, const Q& q) {
  detail::set_coordinates(s, q, &gen_coord<>::q, "q");
  return mass_matrix(c, s);
}

namespace detail {
/// M^-1 (f + tau), f from the passes without accelerations.
template <class Tau>
const Eigen::VectorXd& accelerate(const kte_map_chain& c, runtime_state& s, const Tau& tau) {
  for (int i = 0; i < s.dofs(); ++i) s.coordinate(i).q_ddot = 0;
  evaluate(c, s);
  auto& a = s.work.forces;
  for (int i = 0; i < s.dofs(); ++i) a[i] = s.coordinate(i).f + tau(i);
  mass_matrix(c, s);
  solve_in_place(s.work.mass, a);
  for (int i = 0; i < s.dofs(); ++i) s.coordinate(i).q_ddot = a[i];
  return a;
}
}  // namespace detail

/// Forward dynamics at the state's positions and rates under its inputs: M^-1 f, as on a static chain. The
/// accelerations are also put into the coordinates of the state; its frames hold the motion without them.
inline const Eigen::VectorXd& forward_dynamics(const kte_map_chain& c, runtime_state& s) {
  return detail::accelerate(c, s, [](int) { return 0.0; });
}
/// The same at q, v, which are put into the state, under forces tau besides those of the chain's elements.
template <indexable Q, indexable V, indexable T>
const Eigen::VectorXd& forward_dynamics(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v,
                                        const T& tau) {
  detail::set_coordinates(s, q, &gen_coord<>::q, "q");
  detail::set_coordinates(s, v, &gen_coord<>::q_dot, "v");
  check_size(static_cast<std::size_t>(s.dofs()), tau, "tau");
  return detail::accelerate(c, s, [&](int i) { return static_cast<double>(tau[static_cast<std::size_t>(i)]); });
}

/// Where a frame stands at the state's positions, in the axes in which the bases are given. Only the elements between
/// the bases and the frame are evaluated. A 2D frame is given as one in space. Throws `unknown_name`.
inline pose<mat3<vec3<>>, vec3<>> forward_kinematics(const kte_map_chain& c, runtime_state& s, std::string_view frame) {
  c.check(s);
  const auto& t = c.wiring();
  const kind k = t.kind_of(frame) == kind::frame_2D ? kind::frame_2D : kind::frame_3D;
  const int index = t.find(frame, k);
  detail::check_positions(s);
  detail::move(t, s, k, index);
  if (k == kind::frame_2D) {
    const auto m = spatial(s.get<kind::frame_2D>(index));
    return {as<double>(matrix(m.rotation)), as<double>(m.position)};
  }
  const auto& m = s.get<kind::frame_3D>(index);
  return {m.rotation, m.position};
}
/// The same at q, which is put into the state.
template <indexable Q>
pose<mat3<vec3<>>, vec3<>> forward_kinematics(const kte_map_chain& c, runtime_state& s, const Q& q,
                                              std::string_view frame) {
  detail::set_coordinates(s, q, &gen_coord<>::q, "q");
  return forward_kinematics(c, s, frame);
}

}  // namespace kte
