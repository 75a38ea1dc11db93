#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A joint without constraints: the end moves freely in the base by the coordinate X, a pose.
///
///   p = p_X,  R = R_X,  v = v_X,  w = w_X,  a = a_X + w x v,  al = al_X          (1)
///
/// a_X is the rate of the components of v.
template <kind Dim>
struct free_joint : transmission<free_joint<Dim>> {
  static constexpr type_name type{"free_joint", Dim};
  static constexpr std::array<port, 3> ports{
      {{Dim == kind::frame_2D ? kind::pose_2D : kind::pose_3D, access::angle, "coordinate"},
       {Dim, access::in, "base"},
       {Dim, access::out, "end"}}};

  template <class X>
  KTE_INLINE constexpr auto relative(const X& c) const {
    return motion{
        c.position,        c.rotation, c.velocity, c.ang_velocity, c.acceleration + cross(c.ang_velocity, c.velocity),
        c.ang_acceleration};  // (1)
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// A body that moves freely in the plane: `coordinate`, a pose_2D_key, is the pose of `end` in `base`.
template <class X, class B, class E>
[[nodiscard]] constexpr auto free_joint_2D(const X& coordinate, const B& base, const E& end) {
  return connect(core::free_joint<kind::frame_2D>{}, coordinate, base, end);
}
/// A body that moves freely in space, such as the trunk of a walking robot: `coordinate`, a pose_3D_key, is the pose of
/// `end` in `base`.
template <class X, class B, class E>
[[nodiscard]] constexpr auto free_joint_3D(const X& coordinate, const B& base, const E& end) {
  return connect(core::free_joint<kind::frame_3D>{}, coordinate, base, end);
}

KTE_CALL(free_joint_2D, "(coordinate, base, end)")
KTE_CALL(free_joint_3D, "(coordinate, base, end)")

}  // namespace kte
