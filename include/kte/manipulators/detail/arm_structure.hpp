#pragma once

#include <kte/errors.hpp>
#include <kte/manipulators/detail/singular_axes.hpp>
#include <kte/math/principal_moments.hpp>

#include <cstdint>
#include <limits>

namespace kte {

/// Families of arms with closed-form inverse kinematics; `none`: no closed form.
enum class arm_family : std::uint8_t {
  none,
  planar_3R,           ///< three parallel axes, and a tool in their plane
  scara,               ///< two parallel axes and a slide along them, in either order, and perhaps a third axis
  spherical_wrist,     ///< axes 4, 5, 6 meet in a point
  spherical_shoulder,  ///< axes 1, 2, 3 meet in a point
  three_parallel,      ///< three axes in a row, with 5 and 6 (or 1 and 2) beyond them
  srs,                 ///< seven axes; the first three meet, and the last three
  offset_7R,           ///< seven axes that are one of these with the first or the last locked
  on_track,            ///< six axes with a closed form, on a slide or with a slide at the tool
  free_body            ///< a coordinate that is the pose of a body, and no joints
};

}  // namespace kte

namespace kte::detail {

/// The formulas to use (detail/solve_closed_form.hpp).
enum class closed_form : std::uint8_t {
  none,
  planar,
  scara,
  wrist_parallel,
  wrist_general,
  parallel_meeting,
  parallel_general,
  srs,
  free_body
};

constexpr double root_of(double x) {
  double unit = 1;
  if (!(x > 0 && x <= (std::numeric_limits<double>::max)())) return x < 0 ? 0 : x;
  while (x < 1) x *= 4, unit /= 2;  // exact
  while (x > 4) x /= 4, unit *= 2;
  return unit * constexpr_sqrt(x);
}
constexpr double norm(const vec3<>& v) { return root_of(dot(v, v)); }
constexpr vec3<> direction_of(const vec3<>& v) { return (1 / norm(v)) * v; }
/// v without its component along a unit vector.
constexpr vec3<> normal_part(const vec3<>& v, const vec3<>& unit) { return v - dot(v, unit) * unit; }
/// A unit vector normal to a given one.
constexpr vec3<> any_normal(const vec3<>& u) {
  const double x = u.x * u.x, y = u.y * u.y, z = u.z * u.z;
  return direction_of(cross(u, x <= y && x <= z ? vec3<>{1, 0, 0} : y <= z ? vec3<>{0, 1, 0} : vec3<>{0, 0, 1}));
}

/// The relative placement of the axes of joints.
struct axes_of {
  const arm_geometry& arm;

  constexpr const vec3<>& h(int i) const { return arm.axis[static_cast<std::size_t>(i)]; }
  constexpr const vec3<>& p(int i) const { return arm.point[static_cast<std::size_t>(i)]; }
  /// The sine of the angle between two axes.
  constexpr double sine(int i, int j) const { return norm(cross(h(i), h(j))); }
  /// The point closest to two axes that are not parallel, and their distance, m.
  struct meeting {
    vec3<> at{};
    double miss = 1e300;
  };
  constexpr meeting meet(int i, int j) const {
    const vec3<> n = cross(h(i), h(j)), d = p(j) - p(i);
    const double nn = dot(n, n);
    if (nn < 1e-12) return {};
    const vec3<> a = p(i) + (dot(cross(d, h(j)), n) / nn) * h(i), b = p(j) + (dot(cross(d, h(i)), n) / nn) * h(j);
    return {0.5 * (a + b), norm(a - b)};
  }
  /// For three axes: the point where the two that are farthest from parallel meet.
  constexpr meeting meet(int i, int j, int k) const {
    const double ij = sine(i, j), jk = sine(j, k), ik = sine(i, k);
    const bool first = ij >= jk && ij >= ik, second = jk >= ik;
    meeting m = first ? meet(i, j) : second ? meet(j, k) : meet(i, k);
    const int rest = first ? k : second ? i : j;
    const double off = norm(cross(h(rest), m.at - p(rest)));
    if (m.miss < off) m.miss = off;
    return m;
  }
};

/// The tolerance, after a check of its range.
constexpr double checked_tolerance(double tolerance) {
  if (!(tolerance > 0 && tolerance < 0.1))
    raise<bad_parameter>(
        "kte: the tolerance within which axes count as parallel and as meeting must be between 0 and "
        "0.1, got " +
        number(tolerance));
  return tolerance;
}

/// An arm with the data that the formulas need. Joint i of `arm` rotates by t_i = sign_i q_i about its axis. Origins of
/// joints whose axes meet are moved to their common point.
struct arm_structure {
  arm_family family = arm_family::none;
  closed_form form = closed_form::none;
  bool backwards = false;  ///< `arm` goes from the tool to the base
  int held = -1;           ///< joint that must be locked first: the first or the last; -1: none
  arm_geometry original, arm;
  std::array<double, arm_geometry::most> sign{1, 1, 1, 1, 1, 1, 1, 1};
  double reach = 0;
  /// Tolerance for parallel axes, rad, and for meeting axes, relative to the reach.
  static constexpr double strict = 1e-9;
  double tolerance = strict;

  constexpr const vec3<>& h(int i) const { return arm.axis[static_cast<std::size_t>(i)]; }
  constexpr const vec3<>& p(int i) const { return arm.point[static_cast<std::size_t>(i)]; }
  /// Joint k of `arm` is joint(k) of `original`.
  constexpr std::size_t joint(std::size_t k) const {
    return (backwards ? static_cast<std::size_t>(arm.n - 1) - k : k) + (held == 0 ? 1 : 0);
  }
};

/// The sum of the distances from the first revolute joint to the tool, joint by joint.
constexpr double reach_of(const arm_geometry& a) {
  double sum = 0;
  vec3<> to = a.tool.position;
  for (int i = a.n; i-- > 0;)
    if (const auto k = static_cast<std::size_t>(i); !a.slides[k]) sum += norm(to - a.point[k]), to = a.point[k];
  return sum;
}

/// Reverses axis i if it points against axis j.
constexpr void align(arm_structure& s, int i, int j) {
  const auto k = static_cast<std::size_t>(i);
  if (dot(s.h(i), s.h(j)) < 0) s.arm.axis[k] = -s.arm.axis[k], s.sign[k] = -s.sign[k];
}
constexpr void put_points(arm_structure& s, int first, int last, const vec3<>& at) {
  for (int i = first; i <= last; ++i) s.arm.point[static_cast<std::size_t>(i)] = at;
}

/// For six axes in the order of `s.arm`: whether formulas exist; selects them.
constexpr bool fits_six(arm_structure& s, double most_rad, double most_m) {
  const axes_of a{s.arm};
  const auto wrist = a.meet(3, 4, 5);
  const bool turns = a.sine(3, 4) > 1e-3 && a.sine(4, 5) > 1e-3;
  if (turns && wrist.miss <= most_m && a.sine(0, 1) > most_rad) {
    put_points(s, 3, 5, wrist.at);
    if (a.sine(1, 2) <= most_rad) {
      align(s, 2, 1);
      s.form = closed_form::wrist_parallel;
    } else {
      // If two of the first axes meet, one equation contains a single angle (quartic_subproblems.hpp).
      if (const auto first = a.meet(0, 1); first.miss <= most_m)
        put_points(s, 0, 1, first.at);
      else if (const auto second = a.meet(1, 2); second.miss <= most_m)
        put_points(s, 1, 2, second.at);
      s.form = closed_form::wrist_general;
    }
    return true;
  }
  if (a.sine(1, 2) <= most_rad && a.sine(1, 3) <= most_rad && a.sine(0, 1) > 1e-3 && a.sine(3, 4) > 1e-3 &&
      a.sine(4, 5) > 1e-3) {
    const auto last = a.meet(4, 5);
    align(s, 2, 1), align(s, 3, 1);
    if (last.miss <= most_m) {
      put_points(s, 4, 5, last.at);
      s.form = closed_form::parallel_meeting;
    } else {
      s.form = closed_form::parallel_general;
    }
    return true;
  }
  return false;
}

constexpr arm_family family_of(closed_form form, bool backwards) {
  switch (form) {
    case closed_form::wrist_parallel:
    case closed_form::wrist_general:
      return backwards ? arm_family::spherical_shoulder : arm_family::spherical_wrist;
    case closed_form::parallel_meeting:
    case closed_form::parallel_general:
      return arm_family::three_parallel;
    default:
      return arm_family::none;
  }
}

/// Selects the direction, from base to tool or reversed, with the simpler formulas.
constexpr bool fits_six_either_way(arm_structure& s, const arm_geometry& arm, double most_rad, double most_m) {
  arm_structure there = s, back = s;
  there.arm = arm, back.arm = reversed(arm), back.backwards = true;
  const bool ahead = fits_six(there, most_rad, most_m), behind = fits_six(back, most_rad, most_m);
  if ((!ahead && !behind) || singular_everywhere(arm, s.reach)) return false;
  const auto simple = [](const arm_structure& x) {
    return x.form == closed_form::wrist_parallel || x.form == closed_form::parallel_meeting;
  };
  s = ahead && (simple(there) || !behind || !simple(back)) ? there : back;
  s.family = family_of(s.form, s.backwards);
  return true;
}

constexpr bool fits_srs(arm_structure& s, double most_m) {
  const axes_of a{s.original};
  const auto shoulder = a.meet(0, 1, 2), wrist = a.meet(4, 5, 6);
  const auto turns = [&](int i, int j) { return a.sine(i, j) > 1e-3; };
  if (shoulder.miss > most_m || wrist.miss > most_m || !(turns(0, 1) && turns(1, 2) && turns(4, 5) && turns(5, 6)))
    return false;
  s.arm = s.original;
  put_points(s, 0, 2, shoulder.at), put_points(s, 4, 6, wrist.at);
  // The elbow is the point of axis 4 closest to the shoulder.
  const vec3<> h = s.h(3), e = s.p(3) + dot(shoulder.at - s.p(3), h) * h;
  if (norm(e - shoulder.at) <= most_m || norm(normal_part(wrist.at - e, h)) <= most_m) return false;
  put_points(s, 3, 3, e);
  s.form = closed_form::srs, s.family = arm_family::srs;
  return true;
}

constexpr bool fits_planar(arm_structure& s, double most_rad) {
  const axes_of a{s.original};
  for (int i = 1; i < s.original.n; ++i)
    if (a.sine(0, i) > most_rad) return false;
  if (singular_everywhere(s.original, s.reach)) return false;
  s.arm = s.original;
  for (int i = 1; i < s.original.n; ++i) align(s, i, 0);
  const int n = s.original.n, turning = s.original.turning();
  if (n == 3 && turning == 3) {
    s.form = closed_form::planar, s.family = arm_family::planar_3R;
    return true;
  }
  if ((n == 3 && turning == 2) || (n == 4 && turning == 3)) {
    s.form = closed_form::scara, s.family = arm_family::scara;
    return true;
  }
  return false;
}

/// Seven joints, one of them locked.
constexpr arm_structure with_held(const arm_geometry& arm, int joint, double tolerance) {
  arm_structure s;
  s.original = arm, s.reach = reach_of(arm), s.tolerance = tolerance;
  const auto six = joint == 0 ? part_of(arm, 1, arm.n - 1) : part_of(arm, 0, arm.n - 2);
  if (six.turning() == six.n && fits_six_either_way(s, six, tolerance, tolerance * s.reach)) {
    s.held = joint;
    s.family = arm.slides[static_cast<std::size_t>(joint)] ? arm_family::on_track : arm_family::offset_7R;
  }
  return s;
}

constexpr arm_structure structure_of(const arm_geometry& arm, double tolerance = arm_structure::strict) {
  arm_structure s;
  s.original = arm, s.arm = arm, s.reach = reach_of(arm), s.tolerance = tolerance;
  if (arm.refused == nullptr && arm.moves != arm_geometry::freely::not_at_all) {
    s.reach = 1 + norm(arm.tool.position);  // tolerances are relative to the reach
    s.form = closed_form::free_body, s.family = arm_family::free_body;
  }
  if (!(s.reach * s.reach < std::numeric_limits<double>::infinity())) {
    s.original.refused = "is so large that squares of its lengths overflow";
    s.form = closed_form::none, s.family = arm_family::none;
  }
  if (s.form != closed_form::none || s.original.refused != nullptr || !(s.reach > 0)) return s;
  const double most_m = tolerance * s.reach;
  const bool turns = arm.turning() == arm.n;
  if (arm.n <= 4) {
    fits_planar(s, tolerance);
  } else if (arm.n == 6 && turns) {
    fits_six_either_way(s, arm, tolerance, most_m);
  } else if (arm.n == 7 && !(turns && fits_srs(s, most_m))) {
    const auto first = with_held(arm, 0, tolerance), last = with_held(arm, arm.n - 1, tolerance);
    const bool by_last =
        last.form != closed_form::none && (first.form == closed_form::none || last.form != closed_form::wrist_general);
    if (by_last || first.form != closed_form::none) return by_last ? last : first;
  }
  return s;
}

}  // namespace kte::detail
