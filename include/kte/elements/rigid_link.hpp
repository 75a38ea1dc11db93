#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A rigid link: the end is at position r and rotation R in the base.
///
///   p = r,  rotation R,  no rates          (1)
template <kind Dim, class Rotation, class Position>
struct rigid_link : transmission<rigid_link<Dim, Rotation, Position>> {
  static constexpr type_name type{"rigid_link", Dim};
  static constexpr std::array<port, 2> ports{{{Dim, access::in, "base"}, {Dim, access::out, "end"}}};

  Position position;
  Rotation rotation;

  rigid_link() = default;
  constexpr rigid_link(const Position& r, const Rotation& R) : position(r), rotation(R) {}

  KTE_INLINE constexpr auto relative() const { return at_rest(rotation, position); }  // (1)

  constexpr void check(const parameter_check& where) const {
    where.finite(position, "position must be finite");
    where.rotation(rotation, "rotation must be orthonormal and right-handed");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("position", self.position);
    visit("rotation", self.rotation);
  }
};

/// A coordinate that follows another at a constant distance: q_e = q_b + c, f_b += f_e.
template <class Offset>
struct rigid_link_gen {
  static constexpr type_name type{"rigid_link", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::in, "base"}, {kind::gen, access::out, "end"}}};

  Offset offset;

  template <class C>
  KTE_INLINE constexpr auto doMotion(const C& base) const {
    return coordinate{base.q + offset, base.q_dot, base.q_ddot, skip{}, skip{}};
  }
  template <class C, class F>
  KTE_INLINE constexpr auto doForce(const C&, const F& end) const {
    return make_loads(end);
  }
  constexpr void check(const parameter_check& where) const { where.finite(offset, "offset must be finite"); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("offset", self.offset);
  }
};

}  // namespace core

/// A link in the plane: position of the end in the base, m (`along_x(0.5)`, `vec2{0.3, 0.4}`), and its rotation.
template <class B, class E, geometric Position, class Rotation = no_rotation>
[[nodiscard]] constexpr auto rigid_link_2D(const B& base, const E& end, const Position& position,
                                           const Rotation& rotation = {}) {
  const auto r = detail::planar(position);
  return connect(core::rigid_link<kind::frame_2D, Rotation, std::remove_const_t<decltype(r)>>(r, rotation), base, end);
}

/// A link in space: position of the end in the base, m, and its rotation (`quarter_turn_x`, a matrix, a quaternion).
template <class B, class E, class X, class Y, class Z, class Rotation = no_rotation>
[[nodiscard]] constexpr auto rigid_link_3D(const B& base, const E& end, const vec3<X, Y, Z>& position,
                                           const Rotation& rotation = {}) {
  return connect(core::rigid_link<kind::frame_3D, Rotation, vec3<X, Y, Z>>(position, rotation), base, end);
}

/// A coordinate at a constant distance (m or rad) from another.
template <class B, class E, entry Offset>
[[nodiscard]] constexpr auto rigid_link_gen(const B& base, const E& end, const Offset& offset) {
  const auto c = real(offset);
  return connect(core::rigid_link_gen<std::remove_const_t<decltype(c)>>{c}, base, end);
}

KTE_CALL(rigid_link_gen, "(base, end, offset)")
KTE_CALL(rigid_link_2D, "(base, end, position[, rotation]); a position is a vector, such as kte::along_x(0.5)")
KTE_CALL(rigid_link_3D, "(base, end, position[, rotation]); a position is a vector, such as kte::along_z(0.5)")

}  // namespace kte
