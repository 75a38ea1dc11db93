#pragma once

#include <kte/contract/closure.hpp>
#include <kte/contract/contact.hpp>
#include <kte/math/select.hpp>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace kte::detail {

/// The basis of a contact in axes of its surface: the normal, and tangents.
template <class S = double>
using contact_basis = std::array<vec3<S>, 3>;
template <class S>
contact_basis<S> basis_along(const vec3<S>& n, const vec3<S>& t) {
  return {n, t, vec3<S>(cross(n, t))};
}
/// With tangents of any direction; `planar`: in the plane x, y.
template <class S>
contact_basis<S> basis_at(const vec3<S>& n, bool planar) {
  using std::abs;
  using std::sqrt;
  if (planar) return basis_along(n, vec3<S>{n.y, -n.x, S(0)});
  const auto upright = abs(n.x) < S(0.6);
  const vec3<S> other{select(upright, S(1), S(0)), select(upright, S(0), S(1)), S(0)};
  const vec3<S> t = cross(n, other);
  return basis_along(n, vec3<S>(S(1 / sqrt(dot(t, t))) * t));
}

inline constexpr std::size_t row_lanes = 4;  ///< rows of a contact, and one of zeros
/// A contact at a state.
struct contact_at {
  int closure = 0;  ///< its number among closures and contacts
  int slot = 0;     ///< its number among contacts
  bool planar = false;
  bool has_gate = false;            ///< `only_if`
  bool passes = false;              ///< passes through its surface, because its gate is closed
  closing_motion<double> motion{};  ///< of frame 2 in frame 1
  touch place{};
  vec3<> slip{};  ///< velocity of the body on the surface, m/s, in axes of the surface
  contact_basis<> basis{};
  bool touches = false;  ///< whether it is among those that touch
  int first = 0;         ///< its first row among them
  struct entries_at {
    int place = 0;
    std::array<double, row_lanes> entries{};
  };
  std::vector<entries_at> path;  ///< for trees: its rows of B, places in descending order
  int rows() const { return planar ? 2 : 3; }
};

/// Whether a normal is one: surfaces have none at some points.
inline bool is_unit(const vec3<>& normal) {
  const double square = dot(normal, normal);
  return square > 0.5 && square < 2;
}
inline constexpr char no_normal_here[] =
    "its surface has no normal here, as at the centre of a ball or on the axis of a cylinder";
/// The message for a contact whose place is not defined, because of `why`.
inline std::string text_of_no_place(const std::string& contact, std::string_view why) {
  constexpr std::string_view name = "kte: ";
  return "kte: contact '" + contact + "': " + std::string(why.substr(why.starts_with(name) ? name.size() : 0));
}

/// Contacts touch below this gap, relative to the length of the chain.
inline constexpr double touching_gap = 1e-9;
/// Simulations refuse to start with gaps deeper than this, relative to the length of the chain.
inline constexpr double deepest_start = 1e-8;
/// Velocities below this one count as rest, m/s relative to the length of the chain.
inline constexpr double rest_velocity = 1e-9;

}  // namespace kte::detail
