#pragma once

#include <kte/recursions/coriolis.hpp>
#include <kte/tree/composite.hpp>

#include <vector>

/// The Coriolis matrix of body nodes.
namespace kte::tree {

/// Working memory of the Coriolis matrix.
template <class S>
struct coriolis_memory {
  std::vector<engine::coriolis_body<S>> bodies;  ///< by body node
  std::vector<world_axis<S>> changes;            ///< by axis: its rate of change
  wrench_rows<S> by_change, by_axis;             ///< by axis: I^c ds/dt + B^c s, and I^c s
  axis_rows<S> turning;                          ///< by axis: the torque of B^c^T s
  /// C_jk by row from the first axis of the body of j to the last axis beyond it; C_kj for the axes k of other bodies;
  /// M_jk.
  axis_rows<S> rows, columns, masses;

  void resize(std::size_t nodes, std::size_t axes) {
    bodies.resize(nodes), changes.resize(axes);
    by_change.resize(axes), by_axis.resize(axes), turning.resize(3, axes);
    rows.resize(axes, axes), columns.resize(axes, axes);
  }
};

/// The bodies and changes of axes of a tree. Call `place_in_world` first, with `rate` and the velocities of bases in
/// `bodies`, in the axes of the world.
template <class P, class S>
void move_coriolis_bodies(const body_tree<P>& f, memory<P, S>& m, coriolis_memory<S>& x) {
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const body_node<P>& r = f.nodes[i];
    const std::size_t slot = static_cast<std::size_t>(f.bases) + i, first = static_cast<std::size_t>(r.first),
                      end = first + static_cast<std::size_t>(r.axes);
    const world_place<S>& place = m.world[slot];
    const body_motion<S>& on = m.bodies[static_cast<std::size_t>(r.parent)];
    vec3<S> v = on.velocity + cross(on.ang_velocity, place.step), w = on.ang_velocity;
    for (std::size_t k = first; k < end; ++k)
      v = v + m.rate[k] * m.axes[k].linear, w = w + m.rate[k] * m.axes[k].angular;
    m.bodies[slot].velocity = v, m.bodies[slot].ang_velocity = w;
    for (std::size_t k = first; k < end; ++k) {
      x.changes[k] = engine::change_of(m.axes[k], v, w);
      if (r.moves != joint::varying) [[likely]]
        continue;
      const world_axis<S> own = rate_of_axis(r, m.joint_transforms[i], static_cast<int>(k - first), &m.rate[first]);
      x.changes[k] = {x.changes[k].linear + place.rotation * own.linear,
                      x.changes[k].angular + place.rotation * own.angular};
    }
    x.bodies[i] = engine::coriolis_of<S>({S(r.weight.mass), place.rotation * as<S>(r.weight.moment),
                                          as<S>(congruence(place.rotation, as<S>(r.weight.inertia)))},
                                         v, w);
  }
}

/// C by (3) of recursions/coriolis.hpp, with `Masses` also M by (4), as rows and columns in the working memory: the
/// wrenches of all axes beyond a body pass inward together. Conditions as for `move_coriolis_bodies`.
template <bool Masses, class P, class S>
void coriolis_of_tree(const body_tree<P>& f, memory<P, S>& m, coriolis_memory<S>& x) {
  x.resize(f.nodes.size(), f.axes());
  if constexpr (Masses) x.masses.resize(f.axes(), f.axes());
  move_coriolis_bodies(f, m, x);
  for (std::size_t i = f.nodes.size(); i-- > 0;) {
    const body_node<P>& r = f.nodes[i];
    const engine::coriolis_body<S>& b = x.bodies[i];
    const bool slides = r.moves != joint::revolute, on_base = r.parent < f.bases;
    for (int k = r.first; k < r.first + r.axes; ++k) {
      const auto [by_change, by_axis, turning] =
          engine::coriolis_wrenches(b, m.axes[static_cast<std::size_t>(k)], x.changes[static_cast<std::size_t>(k)]);
      x.by_change.set(k, by_change), x.by_axis.set(k, by_axis);
      x.turning[0][k] = turning.x, x.turning[1][k] = turning.y, x.turning[2][k] = turning.z;
    }
    for (int j = r.first; j < r.first + r.axes; ++j) {
      // Copies, because stores could change what references refer to.
      const world_axis<S> axis = m.axes[static_cast<std::size_t>(j)], change = x.changes[static_cast<std::size_t>(j)];
      const S* const turning = x.turning[0];
      const std::size_t row = x.turning.stride();
      S *const to_row = x.rows[j], *const to_column = x.columns[j], *const to_mass = Masses ? x.masses[j] : nullptr;
      for_each_simd_to<S>(r.last, r.first, [=, &x](int k) KTE_INLINE_LAMBDA {
        simd_wrench<S> by_change, by_axis;
        vec3<simd<S>> third;
        simd<S> power;
        x.by_change.get_simd(k, by_change), x.by_axis.get_simd(k, by_axis);
        by_change.power_on(axis, power, slides);
        store<S>(power, to_row + k);
        load_vectors(third, turning + k, row);
        by_axis.power_on(change, power);
        power += axis.angular.x * third.x + axis.angular.y * third.y + axis.angular.z * third.z;
        store<S>(power, to_column + k);
        if constexpr (Masses) {
          by_axis.power_on(axis, power, slides);
          store<S>(power, to_mass + k);
        }
      });
    }
    if (on_base) continue;
    const vec3<S> step = m.world[static_cast<std::size_t>(f.bases) + i].step;
    for (wrench_rows<S>* const w : {&x.by_change, &x.by_axis})
      w->change_torques(r.first, r.last, [=](simd_wrench<S>& load, int) KTE_INLINE_LAMBDA { load.go_back(step); });
    engine::carry_coriolis_body(b, step, x.bodies[static_cast<std::size_t>(r.parent - f.bases)]);
  }
}
/// Calls put(j, k, C_jk, M_jk) for each ordered pair of axes that move a body together; without masses M_jk is 0.
template <bool Masses, class P, class S, class Put>
void for_each_coriolis_term(const body_tree<P>& f, const coriolis_memory<S>& x, const Put& put) {
  for (const body_node<P>& r : f.nodes)
    for (int j = r.first; j < r.first + r.axes; ++j)
      for (int k = r.first; k < r.last; ++k) {
        const S mass = Masses ? x.masses[j][k] : S(0);
        put(j, k, x.rows[j][k], mass);
        if (k >= r.first + r.axes) put(k, j, x.columns[j][k], mass);
      }
}

}  // namespace kte::tree
