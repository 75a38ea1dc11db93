#pragma once

#include <kte/contract/thing.hpp>
#include <kte/math/rigid_body.hpp>

#include <ostream>
#include <vector>

/// `std::cout << x` for numbers, vectors, frames and coordinates. The precision is that of the stream, six digits by
/// default. Typed constants are shown as their literals, `0_c`, which distinguishes them from numbers.
namespace kte {

namespace detail {
/// "(a, b, c)"
template <class First, class... Rest>
std::ostream& print_row(std::ostream& out, const First& first, const Rest&... rest) {
  out << '(' << first;
  ((out << ", " << rest), ...);
  return out << ')';
}
/// "position (0, 0, 1), velocity (0, 0, 0)": alternating names and values.
inline std::ostream& print_fields(std::ostream& out) { return out; }
template <class Value, class... Rest>
std::ostream& print_fields(std::ostream& out, const char* name, const Value& value, const Rest&... rest) {
  out << name << ' ' << value << (sizeof...(Rest) > 0 ? ", " : "");
  return print_fields(out, rest...);
}
/// A list of any length.
template <class List>
std::ostream& print_list(std::ostream& out, const List& list) {
  const char* before = "[";
  for (const auto& x : list) out << before << x, before = ", ";
  return out << (list.size() == 0 ? "[]" : "]");
}
}  // namespace detail

template <int N>
std::ostream& operator<<(std::ostream& out, constant<N>) {
  return out << N << "_c";
}
inline std::ostream& operator<<(std::ostream& out, skip) { return out << "skip"; }

template <class X, class Y>
std::ostream& operator<<(std::ostream& out, const vec2<X, Y>& v) {
  return detail::print_row(out, v.x, v.y);
}
template <class X, class Y, class Z>
std::ostream& operator<<(std::ostream& out, const vec3<X, Y, Z>& v) {
  return detail::print_row(out, v.x, v.y, v.z);
}
/// By rows.
template <class... R>
std::ostream& operator<<(std::ostream& out, const mat3<R...>& m) {
  return detail::print_row(out, m.x, m.y, m.z);
}
/// xx, xy, xz, yy, yz, zz
template <class... T>
std::ostream& operator<<(std::ostream& out, const sym3<T...>& m) {
  return detail::print_row(out, m.xx, m.xy, m.xz, m.yy, m.yz, m.zz);
}
template <class C, class S>
std::ostream& operator<<(std::ostream& out, const rotation_2D<C, S>& r) {
  return detail::print_fields(out << '(', "cos", r.cos, "sin", r.sin) << ')';
}
inline std::ostream& operator<<(std::ostream& out, no_rotation) { return out << "none"; }
template <class S>
std::ostream& operator<<(std::ostream& out, const unit_quaternion<S>& q) {
  return detail::print_fields(out << '(', "w", q.w, "x", q.x, "y", q.y, "z", q.z) << ')';
}
template <class M, class C, class I>
std::ostream& operator<<(std::ostream& out, const rigid_body<M, C, I>& b) {
  detail::print_fields(out, "mass", b.mass, "com", b.com, "inertia", b.inertia);
  return out << (b.published ? ", as published" : "");
}
template <class F, class T>
std::ostream& operator<<(std::ostream& out, const wrench<F, T>& w) {
  return detail::print_fields(out, "force", w.force, "torque", w.torque);
}
template <class R, class P>
std::ostream& operator<<(std::ostream& out, const pose<R, P>& x) {
  return detail::print_fields(out, "position", x.position, "rotation", x.rotation);
}
template <class... M>
std::ostream& operator<<(std::ostream& out, const motion<M...>& x) {
  return detail::print_fields(out, "position", x.position, "rotation", x.rotation, "velocity", x.velocity,
                              "ang_velocity", x.ang_velocity, "acceleration", x.acceleration, "ang_acceleration",
                              x.ang_acceleration);
}

namespace detail {
/// The fields of frames, and of coordinates that are poses, in addition to position and rotation.
template <class X>
std::ostream& print_rates(std::ostream& out, const X& x) {
  return print_fields(out << ", ", "velocity", x.velocity, "ang_velocity", x.ang_velocity, "acceleration",
                      x.acceleration, "ang_acceleration", x.ang_acceleration, "force", x.force, "torque", x.torque);
}
}  // namespace detail

template <class S>
std::ostream& operator<<(std::ostream& out, const frame_2D<S>& x) {
  return detail::print_rates(detail::print_fields(out, "position", x.position, "rotation", x.rotation), x);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const frame_3D<S>& x) {
  return detail::print_rates(detail::print_fields(out, "position", x.position, "rotation", x.rotation), x);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const gen_coord<S>& c) {
  return detail::print_fields(out, "q", c.q, "q_dot", c.q_dot, "q_ddot", c.q_ddot, "f", c.f);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const rotation_coord_3D<S>& c) {
  return detail::print_fields(out, "rotation", c.rotation, "ang_velocity", c.ang_velocity, "ang_acceleration",
                              c.ang_acceleration, "torque", c.torque);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const pose_coord_2D<S>& c) {
  return detail::print_rates(detail::print_fields(out, "position", c.position, "angle", c.angle), c);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const pose_coord_3D<S>& c) {
  return detail::print_rates(detail::print_fields(out, "position", c.position, "rotation", c.rotation), c);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const internal_state<S>& x) {
  return detail::print_fields(out, "z", x.z, "z_dot", x.z_dot);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const loop_state<S>& x) {
  return detail::print_fields(out, "residual", x.residual, "ang_residual", x.ang_residual, "force", x.force, "torque",
                              x.torque);
}
template <class S>
std::ostream& operator<<(std::ostream& out, const contact_state<S>& x) {
  static constexpr std::string_view names[]{"open", "sticks", "slides"};
  out << names[static_cast<std::size_t>(mode_of(x))] << ' ';
  return detail::print_fields(out, "gap", x.gap, "slip", x.slip, "force", x.force);
}

}  // namespace kte
