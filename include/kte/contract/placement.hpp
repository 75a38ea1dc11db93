#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A joint with a constant placement at position r and rotation R in the base: a link and a joint in one.
///
///   X_end = (r, R) X_joint;  all rates, in the axes of the end, are those of the joint      (1)
template <class Joint, class Rotation, class Position>
struct placed_joint : Joint, transmission<placed_joint<Joint, Rotation, Position>> {  // with whatever else a joint has
  using transmission<placed_joint>::doMotion, transmission<placed_joint>::doForce;

  static constexpr std::array<std::string_view, 2> optional_parameters{"position", "rotation"};

  Position position{};
  Rotation rotation{};

  /// Without a placement; rotations of numbers are the identity.
  constexpr placed_joint() : Joint() {
    if constexpr (requires { rotation.cos = 1; }) rotation.cos = 1;
    if constexpr (requires { rotation.x.x = 1, rotation.y.y = 1, rotation.z.z = 1; })
      rotation.x.x = 1, rotation.y.y = 1, rotation.z.z = 1;
  }
  constexpr placed_joint(const Joint& x, const Position& r, const Rotation& R) : Joint(x), position(r), rotation(R) {}
  constexpr explicit placed_joint(const Joint& x) : placed_joint() { static_cast<Joint&>(*this) = x; }

  template <class... C>
  KTE_INLINE constexpr auto relative(const C&... c) const {
    const auto x = Joint::relative(c...);
    return motion{position + rotation * x.position,
                  rotation * x.rotation,
                  x.velocity,
                  x.ang_velocity,
                  x.acceleration,
                  x.ang_acceleration};  // (1)
  }
  constexpr void check(const parameter_check& where) const {
    Joint::check(where);
    where.finite(position, "position must be finite");
    where.rotation(rotation, "rotation must be orthonormal and right-handed");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    Joint::parameters(self, visit);
    visit("position", self.position);
    visit("rotation", self.rotation);
  }
};

/// A joint in the plane with a placement of plain numbers.
template <class Joint>
using placed_2D = placed_joint<Joint, rotation_2D<>, vec3<double, double, zero_t>>;
/// A joint in space with a placement of plain numbers.
template <class Joint>
using placed_3D = placed_joint<Joint, mat3<vec3<>>, vec3<>>;

}  // namespace core

namespace detail {

template <class Core>
inline constexpr bool is_placed_joint = false;
template <class Joint, class Rotation, class Position>
inline constexpr bool is_placed_joint<core::placed_joint<Joint, Rotation, Position>> = true;

/// Whether a type is a position, or a rotation, in the plane or in space.
template <kind Dim, class Position>
inline constexpr bool is_position = false;
template <class X, class Y, class Z>
inline constexpr bool is_position<kind::frame_3D, vec3<X, Y, Z>> = true;
template <class X, class Y>
inline constexpr bool is_position<kind::frame_2D, vec2<X, Y>> = true;
template <class X, class Y, class Z>
inline constexpr bool is_position<kind::frame_2D, vec3<X, Y, Z>> = true;
template <kind Dim, class Rotation>
inline constexpr bool turns = std::is_same_v<Rotation, no_rotation> || (requires(const Rotation& r) {
                                matrix(r);
                              } && is_planar_rotation<Rotation> == (Dim == kind::frame_2D));

/// Joints of this library and of users.
template <class Core>
requires(is_transmission<Core> && (port_count<Core> > 2) && !is_placed_joint<Core>) struct placement<Core> {
  static constexpr kind dim = Core::ports.back().what;

  template <class Position, class Rotation = no_rotation>
  static constexpr auto of(const Core& joint, const Position& position, const Rotation& rotation = {}) {
    constexpr bool fits = is_position<dim, Position> && turns<dim, Rotation>;
    static_assert(rule < Core, Position, fits || dim != kind::frame_2D >,
                  "kte: call it as .at(position[, rotation]), such as .at(kte::along_x(0.5), kte::rotation_by(0.3))");
    static_assert(rule < Core, Position, fits || dim != kind::frame_3D >,
                  "kte: call it as .at(position[, rotation]), such as .at(kte::along_z(0.5), kte::quarter_turn_x)");
    static_assert(rule<Core, void, loads_by_relative<Core>>,
                  "kte: a joint with its own `doForce` cannot be placed: put that force into an element on the "
                  "coordinate");
    if constexpr (!fits || !loads_by_relative<Core>) {
      return refused{};
    } else if constexpr (dim == kind::frame_2D) {
      const auto r = planar(position);
      return core::placed_joint<Core, Rotation, std::remove_const_t<decltype(r)>>(joint, r, rotation);
    } else {
      return core::placed_joint<Core, Rotation, Position>(joint, position, rotation);
    }
  }
};
template <class Joint, class Rotation, class Position>
struct placement<core::placed_joint<Joint, Rotation, Position>> {
  template <class Core, class... Place>
  static constexpr auto of(const Core&, const Place&...) {
    static_assert(rule<Core, void, fit<Core>>, "kte: this joint has a placement already: call .at() once");
    return refused{};
  }
};

}  // namespace detail
}  // namespace kte
