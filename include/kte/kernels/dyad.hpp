#pragma once

#include <kte/errors.hpp>
#include <kte/math/select.hpp>
#include <kte/math/vec.hpp>

#include <cmath>
#include <string>

namespace kte::detail {

/// ", 1.5 rad": an angle in a message; nothing of a pack.
template <class S>
std::string text_of_angle(const S& q) {
  if constexpr (requires { static_cast<double>(q); }) {
    return ", " + number(static_cast<double>(q)) + " rad";
  } else if constexpr (requires { q.value; }) {
    return text_of_angle(q.value);
  } else {
    return {};
  }
}

/// Two bars in the plane, of lengths b and c, between two points r apart: from the first point to where they meet,
///
///   w = (u r + s sqrt(b^2 |r|^2 - u^2) n) / |r|^2,   u = (b^2 - c^2 + |r|^2) / 2          (1)
///
/// n: r turned by a right angle, to the left; s = 1 or -1: on which side. Throws `bad_argument` where the bars are too
/// short, or their difference too long, with the text that cannot() gives.
template <class S, class Cannot>
constexpr vec2<S> dyad(const vec2<S>& r, const S& b, const S& c, const S& side, const Cannot& cannot) {
  using std::sqrt;
  const S rr = r.x * r.x + r.y * r.y, u = (b * b - c * c + rr) / S(2), k = b * b * rr - u * u;
  if (!all(k >= S(0))) [[unlikely]]
    raise<bad_argument>(cannot());
  const S h = side * S(sqrt(k));
  return {(u * r.x - h * r.y) / rr, (u * r.y + h * r.x) / rr};
}

/// The angle from a unit vector e to w, between -pi and pi.
template <class S>
constexpr S angle_from(const vec2<S>& e, const vec2<S>& w) {
  using std::atan2;
  return atan2(S(e.x * w.y - e.y * w.x), S(e.x * w.x + e.y * w.y));
}

}  // namespace kte::detail
