#pragma once

#include <kte/errors.hpp>
#include <kte/math/plain_scalar.hpp>
#include <kte/math/select.hpp>
#include <kte/math/vec.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace kte::detail {

/// "1.5 rad": an angle in a message; for packs "of a pack".
template <class S>
std::string text_of_angle(const S& q) {
  if constexpr (requires { static_cast<double>(q); }) {
    return number(static_cast<double>(q)) + " rad";
  } else if constexpr (requires { q.value; }) {
    return text_of_angle(q.value);
  } else {
    return "of a pack";
  }
}

/// The words of a linkage in messages about positions that it cannot reach.
struct linkage_words {
  const char* name;     ///< of the element
  const char* leads;    ///< the leading coordinate: "crank angle"
  const char* in_line;  ///< what is in line at its dead points
};

[[noreturn, gnu::cold]] inline void raise_no_transmission(bool beyond, const linkage_words& w,
                                                          const std::string& angle) {
  const std::string here = std::string(w.leads) + " " + angle, name = std::string("kte: ") + w.name;
  if (beyond) raise<bad_argument>(name + " cannot be closed at " + here + ", beyond a dead point");
  raise<dead_point>(name + ": dead point at " + here + ", where " + w.in_line +
                    ": the motion from here is undetermined; let another coordinate lead, or use mimic_gen if the "
                    "angles are equal");
}

/// Bars transmit forces at an angle whose squared sine is k / full. k has a rounding error of about eps full, so
/// velocities, which are proportional to 1 / sqrt(k), lose half their digits for k < sqrt(eps) full. This is a dead
/// point, beyond which the leading coordinate does not determine the motion. Integrators come this close at any
/// tolerance and would stop there or turn back. Throws `dead_point` there, except for positions alone; beyond it throws
/// `bad_argument`. angle() is the text of the leading coordinate.
template <class S, class Angle>
KTE_INLINE constexpr void require_transmission(const S& k, const S& full, const linkage_words& w, const Angle& angle,
                                               bool rates = is_dual<S>) {
  using plain = plain_scalar<S>;
  using std::sqrt;
  const plain near_dead = plain(sqrt(std::numeric_limits<plain>::epsilon()));
  if (!all(k >= S(rates ? near_dead : plain(0)) * full)) [[unlikely]]
    raise_no_transmission(any(k < S(-near_dead) * full) || any(k != k), w, angle());
}

/// Two bars in the plane, of lengths b and c, between two points at the distance vector r: the vector from the first
/// point to their joint is
///
///   w = (u r + s sqrt(k) n) / |r|^2,   u = (b^2 - c^2 + |r|^2) / 2,   k = b^2 |r|^2 - u^2          (1)
///
/// n: r rotated by a right angle, to the left. s = 1 or -1 selects the side. k = b^2 c^2 sin^2 of the angle between the
/// bars. Throws if they are in line, too short, or too different in length (`require_transmission`).
template <class S, class Angle>
KTE_INLINE constexpr vec2<S> dyad(const vec2<S>& r, const S& b, const S& c, const S& side, const linkage_words& words,
                                  const Angle& angle, bool rates = is_dual<S>) {
  using std::sqrt;
  const S rr = r.x * r.x + r.y * r.y, u = (b * b - c * c + rr) / S(2), k = b * b * rr - u * u, bc = b * c;
  require_transmission(k, S(bc * bc), words, angle, rates);
  const S h = side * S(sqrt(k)), inverse = S(1) / rr;
  return {(u * r.x - h * r.y) * inverse, (u * r.y + h * r.x) * inverse};
}

/// Products of vectors in the plane: a.b, and a_n.b with a_n, a rotated by a right angle, to the left.
template <class S>
KTE_INLINE constexpr S along(const vec2<S>& a, const vec2<S>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class S>
KTE_INLINE constexpr S across(const vec2<S>& a, const vec2<S>& b) {
  return a.x * b.y - a.y * b.x;
}
/// The unit vector at an angle.
template <class S>
constexpr vec2<S> direction_at(const S& q) {
  using std::cos;
  using std::sin;
  return {S(cos(q)), S(sin(q))};
}
/// The angle from a unit vector e to w, between -pi and pi.
template <class S>
constexpr S angle_from(const vec2<S>& e, const vec2<S>& w) {
  using std::atan2;
  return atan2(across(e, w), along(e, w));
}

}  // namespace kte::detail
