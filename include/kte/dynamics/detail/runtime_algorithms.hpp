#pragma once

#include <kte/chain/kte_map_chain.hpp>
#include <kte/dynamics/runtime_vectors.hpp>
#include <kte/kernels/solve.hpp>

/// The algorithms on runtime chains: loops over elements, which do their part in the working memory of a state.
namespace kte {

namespace detail {

inline void check_positions(const runtime_state& s) {
  bool finite = true, turned = true;
  for_each_runtime_freedom(s, [&](const auto& c, const freedom&) {
    visit_q(c, [&finite](double x) { finite &= x - x == 0; });
    if constexpr (requires { c.rotation; }) {
      const double n = dot(c.rotation, c.rotation);
      turned &= n > 0 && n - n == 0;
    }
  });
  if (!finite) throw bad_argument("kte: a coordinate is no finite number");
  if (!turned) throw bad_argument("kte: the quaternion of a rotation has length 0");
}

/// Sines, cosines and matrices of the coordinates.
inline void update_angles(runtime_state& s) {
  auto& w = s.work;
  for (std::size_t i = 0; i < w.angles.size(); ++i) w.angle[i] = s.get<kind::gen>(w.angles[i]).q;
  sincos_each(w.angle.data(), w.sine.data(), w.cosine.data(), w.angle.size());
  for (std::size_t i = 0; i < w.angles.size(); ++i) {
    auto& c = s.get<kind::gen>(w.angles[i]);
    c.sin = w.sine[i], c.cos = w.cosine[i];
  }
  const auto& t = *s.made_for();
  for (const auto& f : t.free) {
    if (f.what == kind::rotation_3D) update_angle(s.get<kind::rotation_3D>(f.slot));
    if (f.what == kind::pose_2D) update_angle(s.get<kind::pose_2D>(f.slot));
    if (f.what == kind::pose_3D) update_angle(s.get<kind::pose_3D>(f.slot));
  }
  // given from outside, by base_gen
  const auto& writers = t.writers[static_cast<std::size_t>(kind::gen)];
  for (std::size_t i = 0; i < writers.size(); ++i)
    if (w.row_of_gen[i] >= t.nv && writers[i] < 0) update_angle(s.get<kind::gen>(static_cast<int>(i)));
}

/// Frames that no element writes, into the working memory; no forces anywhere.
inline void start(runtime_state& s) {
  for (std::size_t i = 0; i < s.work.row_of_gen.size(); ++i) s.get<kind::gen>(static_cast<int>(i)).f = 0;
  for_each_runtime_freedom(s, [](auto& c, const freedom&) {
    if constexpr (requires { clear_load(c); }) clear_load(c);
  });
  for (const auto& base : s.work.bases) {
    const auto set = [&s, i = base.second]<kind K>(std::integral_constant<kind, K>) {
      const auto m = spatial(s.get<K>(i));
      s.work.frames.get<K>(i) = {
          as<double>(m.ang_velocity), as<double>(m.acceleration), as<double>(m.ang_acceleration), {}};
    };
    if (base.first == kind::frame_2D)
      set(std::integral_constant<kind, kind::frame_2D>{});
    else
      set(std::integral_constant<kind, kind::frame_3D>{});
  }
}

/// The forces of elements that read positions, by the full passes; those on frames are still to be added.
inline void forces_by_positions(const kte_map_chain& c, runtime_state& s) {
  c.doMotion(s);
  c.clearForce(s);
  for (const auto& e : c.wiring().elements)
    if (e.element->reads_positions()) e.element->doForce(s);
}
inline void add_forces_by_positions(runtime_state& s) {
  const auto add = [&s]<kind K>(std::integral_constant<kind, K>, std::size_t n) {
    for (int i = 0; i < static_cast<int>(n); ++i) {
      auto& load = s.work.frames.get<K>(i).load;
      load = dense(load + load_of(s.get<K>(i)));
    }
  };
  add(std::integral_constant<kind, kind::frame_2D>{}, s.work.frames.in_plane.size());
  add(std::integral_constant<kind, kind::frame_3D>{}, s.work.frames.in_space.size());
}

/// Inverse dynamics (RNEA): the forces of virtual power on the coordinates, into the state.
inline void coordinate_forces(const kte_map_chain& c, runtime_state& s) {
  c.check(s);
  const auto& elements = c.wiring().elements;
  update_angles(s);
  start(s);
  if (s.work.reads_positions) forces_by_positions(c, s);
  for (const int e : s.work.movers) elements[static_cast<std::size_t>(e)].element->move(s);
  if (s.work.reads_positions) add_forces_by_positions(s);
  for (auto e = elements.rbegin(); e != elements.rend(); ++e) e->element->push(s);
}

/// The mass matrix over all coordinates (CRBA), into the working memory.
inline void mass_of_coordinates(const topology& t, runtime_state& s) {
  auto& w = s.work;
  for (const auto& e : t.elements)
    if (e.ports.back().how == access::out && !e.stiff && is_frame(e.ports.back().what))
      throw bad_argument("kte: the mass matrix needs joints and links, not " + e.element->record().type);
  const bool followers = w.coordinates > t.nv;
  auto& m = followers ? w.all : w.mass;
  m.setZero();
  w.carried.fill({});
  update_angles(s);
  if (followers)
    for (const int e : w.movers) t.elements[static_cast<std::size_t>(e)].element->update_coordinates(s);
  for (auto e = t.elements.rbegin(); e != t.elements.rend(); ++e) e->element->carry(s);
  for (Eigen::Index j = 0; j < m.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i) m(i, j) = m(j, i) = m(i, j) + m(j, i);
  for (const int e : w.weights) t.elements[static_cast<std::size_t>(e)].element->carry_coordinate(s);
  if (followers) w.mass = w.all.topLeftCorner(t.nv, t.nv);
}

/// The articulated-body algorithm (ABA): forces into accelerations, in s.work.forces.
template <class Tau>
void accelerate_articulated(const kte_map_chain& c, runtime_state& s, const Tau& tau) {
  auto& w = s.work;
  const auto& elements = c.wiring().elements;
  update_angles(s);
  start(s);
  if (w.reads_positions) forces_by_positions(c, s);
  std::fill(w.own_mass.begin(), w.own_mass.end(), 0.0);
  for (const auto& [k, i] : w.bases) {
    const auto& x = k == kind::frame_2D ? w.frames.get<kind::frame_2D>(i) : w.frames.get<kind::frame_3D>(i);
    (k == kind::frame_2D ? w.accelerations.get<kind::frame_2D>(i) : w.accelerations.get<kind::frame_3D>(i)) = {
        x.acceleration, x.ang_acceleration};
    (k == kind::frame_2D ? w.burdens.get<kind::frame_2D>(i) : w.burdens.get<kind::frame_3D>(i)) = {};
  }
  for (const auto& e : elements) e.element->move_by_rates(s);
  if (w.reads_positions) add_forces_by_positions(s);
  read_numbers<vector_of::f>(s, w.forces);
  for (int i = 0; i < s.dofs(); ++i) w.forces[i] += tau(i);
  w.good = true;
  for (auto e = elements.rbegin(); e != elements.rend(); ++e) e->element->articulate(s);
  for (const int e : w.movers) elements[static_cast<std::size_t>(e)].element->accelerate(s);
  for (const int row : w.lone_rows) {
    const double m = w.own_mass[static_cast<std::size_t>(row)];
    w.good &= m > 0;
    w.forces[row] /= m;
  }
  if (!w.good) throw singular_mass_matrix("kte: the mass matrix is singular: a coordinate moves no mass of its own");
}
/// By the factorised mass matrix.
template <class Tau>
void accelerate_by_mass(const kte_map_chain& c, runtime_state& s, const Tau& tau) {
  for_each_runtime_freedom(s, [](auto& x, const freedom&) { visit_a(x, [](double& a) { a = 0; }); });
  coordinate_forces(c, s);
  auto& a = s.work.forces;
  read_numbers<vector_of::f>(s, a);
  for (int i = 0; i < s.dofs(); ++i) a[i] += tau(i);
  mass_of_coordinates(c.wiring(), s);
  solve_in_place(s.work.mass, a);
}
template <class Tau>
const Eigen::VectorXd& accelerations_under(const kte_map_chain& c, runtime_state& s, const Tau& tau) {
  c.check(s);
  check_positions(s);
  if (s.work.tree)
    accelerate_articulated(c, s, tau);
  else
    accelerate_by_mass(c, s, tau);
  check_finite(s.work.forces, static_cast<std::size_t>(s.dofs()),
               "kte: an acceleration is no finite number: an argument is none");
  write_numbers<vector_of::a>(s, s.work.forces, "a");
  return s.work.forces;
}

/// doMotion of all elements that a thing depends on.
inline void move(const topology& t, runtime_state& s, kind k, int index) {
  const int w = t.writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(index)];
  if (w < 0) return;
  const auto& e = t.elements[static_cast<std::size_t>(w)];
  for (std::size_t p = 0; p < e.ports.size(); ++p)
    if (!e.ports[p].writes() && e.ports[p].what != kind::input) move(t, s, e.ports[p].what, e.index[p]);
  e.element->doMotion(s);
}

}  // namespace detail

}  // namespace kte
