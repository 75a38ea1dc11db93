#pragma once

#include <kte/contract/thing.hpp>

#include <span>
#include <string_view>

/// Quantities of coordinates, frames, inputs and internal states that can be recorded.
namespace kte::detail {

/// A quantity of an item: one or several numbers.
template <class Thing>
struct quantity {
  std::string_view name;                    ///< empty for the item itself
  char group;                               ///< q: positions; v, a: their rates; f: forces
  std::string_view components;              ///< one character each; empty for a single number
  void (*read)(const Thing&, double* out);  ///< reads all components

  std::size_t size() const { return components.empty() ? 1 : components.size(); }
};

template <class S>
void put_numbers(double* out, const S& x) {
  *out = static_cast<double>(x);
}
template <class S>
void put_numbers(double* out, const vec2<S>& v) {
  put_numbers(out, v.x), put_numbers(out + 1, v.y);
}
template <class S>
void put_numbers(double* out, const vec3<S>& v) {
  put_numbers(out, v.x), put_numbers(out + 1, v.y), put_numbers(out + 2, v.z);
}
template <class S>
void put_numbers(double* out, const unit_quaternion<S>& q) {
  put_numbers(out, q.w), put_numbers(out + 1, q.x), put_numbers(out + 2, q.y), put_numbers(out + 3, q.z);
}
template <class S>
void put_numbers(double* out, const mat3<vec3<S>>& rotation) {
  put_numbers(out, to_quaternion(rotation));
}
template <class S>
void put_numbers(double* out, const rotation_2D<S>& rotation) {
  put_numbers(out, angle(rotation));
}

/// Reads a member as a quantity.
template <auto Member, class Thing>
void read_member(const Thing& x, double* out) {
  put_numbers(out, x.*Member);
}

template <class Thing>
struct quantities_of;

template <class S>
struct quantities_of<gen_coord<S>> {
  using T = gen_coord<S>;
  static constexpr quantity<T> list[]{{"", 'q', "", read_member<&T::q>},
                                      {"v", 'v', "", read_member<&T::q_dot>},
                                      {"a", 'a', "", read_member<&T::q_ddot>},
                                      {"f", 'f', "", read_member<&T::f>}};
};
template <class S>
struct quantities_of<internal_state<S>> {
  using T = internal_state<S>;
  static constexpr quantity<T> list[]{{"", 'q', "", read_member<&T::z>}, {"v", 'v', "", read_member<&T::z_dot>}};
};
template <class S>
struct quantities_of<loop_state<S>> {
  using T = loop_state<S>;
  static constexpr quantity<T> list[]{{"residual", 'q', "xyz", read_member<&T::residual>},
                                      {"ang_residual", 'q', "xyz", read_member<&T::ang_residual>},
                                      {"force", 'f', "xyz", read_member<&T::force>},
                                      {"torque", 'f', "xyz", read_member<&T::torque>}};
};
template <class S>
struct quantities_of<contact_state<S>> {
  using T = contact_state<S>;
  static constexpr quantity<T> list[]{{"gap", 'q', "", read_member<&T::gap>},
                                      {"slip", 'v', "xyz", read_member<&T::slip>},
                                      {"point", 'q', "xyz", read_member<&T::point>},
                                      {"force", 'f', "xyz", read_member<&T::force>},
                                      {"direction", 'v', "xyz", read_member<&T::direction>},
                                      {"mode", 'q', "", read_member<&T::mode>}};
};
template <class S>
struct quantities_of<rotation_coord_3D<S>> {
  using T = rotation_coord_3D<S>;
  static constexpr quantity<T> list[]{{"rotation", 'q', "wxyz", read_member<&T::rotation>},
                                      {"ang_velocity", 'v', "xyz", read_member<&T::ang_velocity>},
                                      {"ang_acceleration", 'a', "xyz", read_member<&T::ang_acceleration>},
                                      {"torque", 'f', "xyz", read_member<&T::torque>}};
};
/// Poses and frames in space.
template <class T>
struct quantities_in_space {
  static constexpr quantity<T> list[]{{"position", 'q', "xyz", read_member<&T::position>},
                                      {"rotation", 'q', "wxyz", read_member<&T::rotation>},
                                      {"velocity", 'v', "xyz", read_member<&T::velocity>},
                                      {"ang_velocity", 'v', "xyz", read_member<&T::ang_velocity>},
                                      {"acceleration", 'a', "xyz", read_member<&T::acceleration>},
                                      {"ang_acceleration", 'a', "xyz", read_member<&T::ang_acceleration>},
                                      {"force", 'f', "xyz", read_member<&T::force>},
                                      {"torque", 'f', "xyz", read_member<&T::torque>}};
};
/// Poses and frames in the plane; Angle is the member with their rotation.
template <class T, auto Angle>
struct quantities_in_plane {
  static constexpr quantity<T> list[]{{"position", 'q', "xy", read_member<&T::position>},
                                      {"angle", 'q', "", read_member<Angle>},
                                      {"velocity", 'v', "xy", read_member<&T::velocity>},
                                      {"ang_velocity", 'v', "", read_member<&T::ang_velocity>},
                                      {"acceleration", 'a', "xy", read_member<&T::acceleration>},
                                      {"ang_acceleration", 'a', "", read_member<&T::ang_acceleration>},
                                      {"force", 'f', "xy", read_member<&T::force>},
                                      {"torque", 'f', "", read_member<&T::torque>}};
};
template <class S>
struct quantities_of<pose_coord_3D<S>> : quantities_in_space<pose_coord_3D<S>> {};
template <class S>
struct quantities_of<frame_3D<S>> : quantities_in_space<frame_3D<S>> {};
template <class S>
struct quantities_of<pose_coord_2D<S>> : quantities_in_plane<pose_coord_2D<S>, &pose_coord_2D<S>::angle> {};
template <class S>
struct quantities_of<frame_2D<S>> : quantities_in_plane<frame_2D<S>, &frame_2D<S>::rotation> {};
template <class S>
struct quantities_of<vec3<S>> {
  static constexpr quantity<vec3<S>> list[]{
      {"", 'q', "xyz", [](const vec3<S>& x, double* out) { put_numbers(out, x); }}};
};
/// Signals that are numbers.
template <class S>
struct quantities_of {
  static constexpr quantity<S> list[]{{"", 'q', "", [](const S& x, double* out) { put_numbers(out, x); }}};
};

/// The quantities of a kind of item, in states of a scalar.
template <kind K, class S>
inline constexpr auto& quantities = quantities_of<thing_of<K, S>>::list;

/// Calls visit.operator()<K>() with K = k.
template <class Visit>
void with_kind(kind k, const Visit& visit) {
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    ((static_cast<std::size_t>(k) == K ? visit.template operator()<static_cast<kind>(K)>() : void()), ...);
  }
  (std::make_index_sequence<kinds>{});
}

}  // namespace kte::detail
