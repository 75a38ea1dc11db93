#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A spherical joint: the end turns in the base by a coordinate X that is a rotation.
///
///   p = 0,  R = R_X,  v = 0,  w = w_X,  a = 0,  al = al_X          (1)
struct spherical_joint : transmission<spherical_joint> {
  static constexpr type_name type{"spherical_joint", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::rotation_3D, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};

  template <class X>
  KTE_INLINE constexpr auto relative(const X& c) const {
    return motion{zero3{}, c.rotation, zero3{}, c.ang_velocity, zero3{}, c.ang_acceleration};  // (1)
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// A spherical joint. `coordinate`, a rotation_3D_key, is the rotation of `end` in `base`; it has no singular
/// configurations.
template <class X, class B, class E>
[[nodiscard]] constexpr auto spherical_joint_3D(const X& coordinate, const B& base, const E& end) {
  return connect(core::spherical_joint{}, coordinate, base, end);
}

KTE_CALL(spherical_joint_3D, "(coordinate, base, end)")

}  // namespace kte
