#pragma once

#include <kte/tree/jacobian.hpp>

namespace kte::tree {

/// The columns u, w of the Jacobian of a frame in its own axes with their time derivatives, from the frame to its base:
/// put(k, u, w, du/dt, dw/dt). If axes are constant in the body that the joint moves, a column changes only by the
/// velocity V, W of the frame relative to this body, in the axes of the frame (Featherstone 2008, section 2.10):
///
///   du/dt = u x W + w x V,   dw/dt = w x W          (1)
///   V, W = sum u_i q_i', w_i q_i'  over the joints between the two          (2)
///
/// For varying axes the column of their change is added.
/// `moves`: returns V, W relative to the base. Needs `rate`. Returns the slot, as `pose_in_base`.
template <class P, class S, class Put>
int jacobian_rate_columns(const body_tree<P>& f, const memory<P, S>& m, const frame_place<P>& frame, dense_pose<S>& x,
                          world_axis<S>& moves, const Put& put) {
  world_axis<S> beyond{}, with_own{};
  const auto visit = [&](const body_node<P>& r, const joint_transform<S>& at, const auto& units, const auto& p) {
    columns_of_joint(r, at, units, p, [&](int k, const auto& linear, const auto& angular) KTE_INLINE_LAMBDA {
      const vec3<S> u = components<S>(linear), w = components<S>(angular);
      world_axis<S> own{};
      if (r.moves == joint::varying) [[unlikely]] {
        const auto change = rate_of_axis(r, at, k - r.first, &m.rate[static_cast<std::size_t>(r.first)]);
        const auto column = engine::jacobian_column(rotation_of_units<direction<S>>{units}, p,
                                                    engine::motion_vector{change.linear, change.angular});
        own = {components<S>(column.linear), components<S>(column.angular)};
      }
      put(k, u, w, vec3<S>(cross(u, beyond.angular) + cross(w, beyond.linear) + own.linear),
          vec3<S>(cross(w, beyond.angular) + own.angular));  // (1)
      const S& rate = m.rate[static_cast<std::size_t>(k)];
      with_own = {with_own.linear + rate * u, with_own.angular + rate * w};  // (2)
    });
    beyond = with_own;
  };
  const int base = each_joint_inward(f, m, frame, x, visit);
  moves = with_own;
  return base;
}

}  // namespace kte::tree
