#pragma once

#include <kte/recursions/regressor.hpp>
#include <kte/tree/columns.hpp>
#include <kte/tree/composite.hpp>

/// The regressor of body nodes: the forces on several axes at a time.
namespace kte::tree {

/// Writes the velocities by unit rates of all axes to rows: v, u at the origin of the first body on their path, in axes
/// of the base. `world` gets the places of bodies there. Far away bodies lose no digits. Call `place_bodies` first.
template <class P, class S>
void put_axes_in_rows(const body_tree<P>& f, memory<P, S>& m, axis_rows<S>& rows) {
  for (std::size_t b = 0; b < static_cast<std::size_t>(f.bases); ++b)
    m.world[b] = {{{S(1), S(0), S(0)}, {S(0), S(1), S(0)}, {S(0), S(0), S(1)}}, {}, {}};
  place_bodies_in_world<world_place<S>>(f, m, m.axes.data());
  rows.resize(6, f.axes());
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const body_node<P>& r = f.nodes[i];
    auto& place = m.world[static_cast<std::size_t>(f.bases) + i];
    if (r.parent < f.bases)
      place.position = {};
    else
      place.position = m.world[static_cast<std::size_t>(r.parent)].position + place.step;
    for (int k = r.first; k < r.first + r.axes; ++k) {
      const world_axis<S>& s = m.axes[static_cast<std::size_t>(k)];
      const vec3<S> v = s.linear + cross(place.position, s.angular);
      rows[0][k] = v.x, rows[1][k] = v.y, rows[2][k] = v.z;
      rows[3][k] = s.angular.x, rows[4][k] = s.angular.y, rows[5][k] = s.angular.z;
    }
  }
}
/// The forces on all axes for the motion of a body fixed to a frame, by inertial parameters: put(k, first, y) for as
/// many axes from k on as a register holds; y is zero for axes before `first`, and k may be negative. Axes of a path
/// come from the body to the base. Call `move_bodies` and `put_axes_in_rows` first.
template <class P, class S, class Put>
void forces_by_parameters(const body_tree<P>& f, const memory<P, S>& m, const axis_rows<S>& rows,
                          const frame_place<P>& frame, const Put& put) {
  using numbers = simd<S>;
  const body_motion<S>& b = m.bodies[static_cast<std::size_t>(frame.slot)];
  const auto x = compose(motion{skip{}, no_rotation{}, skip{}, b.ang_velocity, b.acceleration, b.ang_acceleration},
                         at_rest(as<S>(frame.at.rotation), as<S>(frame.at.position)));
  const world_place<S>& place = m.world[static_cast<std::size_t>(frame.slot)];
  const mat3<vec3<S>> r = place.rotation * as<S>(frame.at.rotation);
  const vec3<S> p = place.position + place.rotation * as<S>(frame.at.position);
  for (int slot = frame.slot; slot >= f.bases;) {
    const body_node<P>* node = &f.nodes[static_cast<std::size_t>(slot - f.bases)];
    const int end = node->first + node->axes;
    int first = end;
    while (slot >= f.bases && node->first + node->axes == first) {  // as long as axes are side by side
      first = node->first, slot = node->parent;
      if (slot >= f.bases) node = &f.nodes[static_cast<std::size_t>(slot - f.bases)];
    }
    for_each_simd_to<S>(end, first, [&](int k) KTE_INLINE_LAMBDA {
      numbers row[6];
      for (int i = 0; i < 6; ++i) load<S>(row[i], rows[i] + k);
      for (int before = k; before < first; ++before)
        for (numbers& rates : row) simd_lane<S>(before - k).put(rates, S(0));
      const vec3<numbers> u{row[3], row[4], row[5]};
      const vec3<numbers> v{row[0] + (u.y * p.z - u.z * p.y), row[1] + (u.z * p.x - u.x * p.z),
                            row[2] + (u.x * p.y - u.y * p.x)};
      const auto in_frame = [&r](const vec3<numbers>& y, vec3<numbers>& to) KTE_INLINE_LAMBDA {
        to.x = y.x * r.x.x + y.y * r.y.x + y.z * r.z.x;
        to.y = y.x * r.x.y + y.y * r.y.y + y.z * r.z.y;
        to.z = y.x * r.x.z + y.y * r.y.z + y.z * r.z.z;
      };
      vec3<numbers> seen_v, seen_u;
      in_frame(v, seen_v), in_frame(u, seen_u);
      engine::per_parameter<numbers> y;
      engine::power_by_parameters<S>(x, seen_v, seen_u, y);
      put(k, first, y);
    });
  }
}

}  // namespace kte::tree
