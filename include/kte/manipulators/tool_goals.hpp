#pragma once

#include <kte/manipulators/detail/goal_sums.hpp>
#include <kte/manipulators/pose_error.hpp>

#include <string>

namespace kte {

/// Weights of the squares of a goal: `position`, for m, and `rotation`, for radians times a length
/// (`numerical_ik_options`). Weight 0: ignored.
struct pose_weights {
  double position = 1, rotation = 1;
};

namespace detail {
/// A tool of a static manipulator by its key, of a runtime manipulator by its name.
template <class Tool>
struct goal_of_tool {
  static constexpr bool hard = true;
  Tool tool;
};
inline std::string tool_named(const char* name) { return name; }
inline std::string tool_named(std::string name) { return name; }
template <key_type Key>
constexpr Key tool_named(const Key& k) {
  return k;
}
template <class T>
using tool_name = decltype(tool_named(std::declval<const T&>()));

template <class Tool>
struct reach_goal : goal_of_tool<Tool> {
  pose<mat3<vec3<>>, vec3<>> wanted;
  pose_weights weights;

  /// `pose_error` for a pose that needs no check.
  template <class S>
  std::array<S, 6> error(const pose<mat3<vec3<S>>, vec3<S>>& now) const {
    const vec3<S> p = as<S>(wanted.position) - now.position, w = turn_between(now.rotation, as<S>(wanted.rotation));
    return {p.x, p.y, p.z, w.x, w.y, w.z};
  }
  /// Calls sum(e, weight, row) for each error; row(k) is minus its derivative by v_k.
  template <class At, class Sum>
  void add_to(const At& at, Sum& sum) const {
    using S = typename At::scalar;
    const auto t = at.index_of(this->tool);
    const auto e = error(at.poses[t]);
    const S turns = S(weights.rotation) * at.length * at.length;
    for (std::size_t r = 0; r < 6; ++r) {
      const S w = r < 3 ? S(weights.position) : turns;
      if (w > S(0)) sum(e[r], w, [&](Eigen::Index k) { return at.jacobian(static_cast<Eigen::Index>(6 * t + r), k); });
    }
  }
  template <class At>
  auto miss(const At& at) const {
    using std::sqrt;
    using S = typename At::scalar;
    const auto e = error(at.poses[at.index_of(this->tool)]);
    const auto length = [&e](std::size_t i) {
      return S(sqrt(e[i] * e[i] + e[i + 1] * e[i + 1] + e[i + 2] * e[i + 2]));
    };
    return goal_miss<S>{weights.position > 0 ? length(0) : S(0), weights.rotation > 0 ? length(3) : S(0)};
  }
};

template <class Tool>
struct look_at_goal : goal_of_tool<Tool> {
  vec3<> axis, point;

  /// The rotation vector that aligns the axis with the line to the point, and that line.
  template <class At>
  auto error(const At& at, std::size_t t) const {
    using S = typename At::scalar;
    using std::atan2;
    using std::sqrt;
    const auto& x = at.poses[t];
    const vec3<S> u = x.rotation * as<S>(axis), d = as<S>(point) - x.position, n = cross(u, d);
    const S sine = sqrt(dot(n, n)), angle = atan2(sine, dot(u, d));
    const vec3<S> any = u.x * u.x < S(0.5) ? vec3<S>{S(0), -u.z, u.y} : vec3<S>{u.z, S(0), -u.x};  // normal to u
    const S k = sine > S(0) ? S(angle / sine) : S(angle / sqrt(dot(any, any)));
    return std::pair{as<S>(k * (sine > S(0) ? n : any)), d};
  }
  template <class At, class Sum>
  void add_to(const At& at, Sum& sum) const {
    using S = typename At::scalar;
    const auto t = at.index_of(this->tool);
    const auto [e, d] = error(at, t);
    const S dd = dot(d, d), w = at.length * at.length;
    const std::array<S, 3> errors{e.x, e.y, e.z};
    const auto row0 = 6 * static_cast<Eigen::Index>(t);
    const vec3<S> line = d;
    const auto rate = [&at, row0, line,
                       dd](Eigen::Index k) {  // of the axis relative to the line: w + d x v/d^2
      const auto& j = at.jacobian;
      const vec3<S> v{j(row0, k), j(row0 + 1, k), j(row0 + 2, k)};
      const vec3<S> turn{j(row0 + 3, k), j(row0 + 4, k), j(row0 + 5, k)};
      const vec3<S> r = dd > S(0) ? as<S>(turn + cross(line, v) * S(S(1) / dd)) : turn;
      return dd > S(0) ? as<S>(r - line * S(dot(line, r) / dd)) : r;
    };
    sum(errors[0], w, [&](Eigen::Index k) { return rate(k).x; });
    sum(errors[1], w, [&](Eigen::Index k) { return rate(k).y; });
    sum(errors[2], w, [&](Eigen::Index k) { return rate(k).z; });
  }
  template <class At>
  auto miss(const At& at) const {
    using std::sqrt;
    const auto e = error(at, at.index_of(this->tool)).first;
    return goal_miss<typename At::scalar>{0, sqrt(dot(e, e))};
  }
};
}  // namespace detail

/// A goal of `numerical_inverse_kinematics`: the tool at a pose in axes of the world. Throws `bad_argument` for a pose
/// that is not finite, and for a rotation that is not orthonormal to 1e-6.
template <class Tool, class R, class P>
[[nodiscard]] auto reach(const Tool& tool, const pose<R, P>& wanted, const pose_weights& weights = {}) {
  const auto p = detail::finite_place(wanted.position);
  return detail::reach_goal<detail::tool_name<Tool>>{{detail::tool_named(tool)},
                                                     {as<double>(matrix(detail::quaternion_of(wanted.rotation))), p},
                                                     detail::checked(weights)};
}
/// A goal: the origin of the tool at a point in axes of the world, m, with any rotation.
template <class Tool, class P>
requires geometric<P>
auto reach_position(const Tool& tool, const P& point) {
  return reach(tool, pose{unit_quaternion<double>{}, point}, {1, 0});
}
/// A goal: a unit vector in axes of the tool, from its origin, points at a point in axes of the world, m.
template <class Tool, class A, class B, class C, class X, class Y, class Z>
[[nodiscard]] auto look_at(const Tool& tool, const vec3<A, B, C>& axis, const vec3<X, Y, Z>& point) {
  const auto u = as<double>(axis);
  if (!(std::abs(dot(u, u) - 1) < 1e-6)) detail::raise<bad_argument>("kte: look_at needs an axis of length 1");
  return detail::look_at_goal<detail::tool_name<Tool>>{{detail::tool_named(tool)}, u, detail::finite_place(point)};
}

}  // namespace kte
