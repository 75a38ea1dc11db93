#pragma once

#include <kte/dynamics/contacts/chosen_contacts.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>

namespace kte {

/// The convex hull of points of contact on one plane, in axes of the frame of its surface.
struct support_polygon_result {
  std::vector<std::string> contacts;  ///< whose points these are
  std::vector<vec3<>> corners;        ///< m, counterclockwise about the normal; two on a line, one at a point
  vec3<> normal{};                    ///< of the plane

  double area() const;  ///< m^2
  /// The distance of a point's projection onto the plane from the boundary, m; negative outside.
  double margin(const vec3<>& point) const;
};

namespace detail {
support_polygon_result support_polygon_at_state(const runtime_chain& c, runtime_state& s, const chosen_contacts& of);
vec3<> centre_of_pressure_at_state(const runtime_chain& c, runtime_state& s, const chosen_contacts& of);
}  // namespace detail

/// The support polygon of contacts with one plane at q, by default of all that touch.
///
///   support_polygon(c, s, q, at_contacts("fl", "fr", "hl")).margin(point)
///
/// Throws `bad_argument` for contacts with surfaces of different frames, or points that are not on one plane;
/// `no_solution` if no contact touches; `unknown_name`.
template <indexable Q>
support_polygon_result support_polygon(const runtime_chain& c, runtime_state& s, const Q& q,
                                       const chosen_contacts& of = {}) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::support_polygon_at_state(c, s, of); });
}
/// The centre of pressure of contacts with one plane, m, in axes of the frame of its surface: where the forces have no
/// moment along the plane. With points c_i and normal forces f_i,
///
///   p = sum f_i c_i / sum f_i          (1)
///
/// from the forces in the state: those of the last `contact_dynamics` or step of simulation. Errors as for
/// `support_polygon`; throws `no_solution` without normal forces.
inline vec3<> centre_of_pressure(const runtime_chain& c, runtime_state& s, const chosen_contacts& of = {}) {
  detail::check_regular_tree(c, s), detail::check_positions(s);
  return detail::centre_of_pressure_at_state(c, s, of);
}

// ---- static chains: as for runtime chains

template <class Gravity, class... E, indexable Q>
[[nodiscard]] support_polygon_result support_polygon(const static_chain<Gravity, E...>& c, const Q& q,
                                                     const chosen_contacts& of = {}) {
  return detail::at_run_time(c, q, [&](auto&... at) { return support_polygon(at..., of); });
}
/// With the forces of `contact_dynamics(c, q, v, tau)`.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] vec3<> centre_of_pressure(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau,
                                        const chosen_contacts& of = {}) {
  return detail::at_run_time(c, q, v, tau,
                             [&](const auto& r, auto& s, const auto& x, const auto& rates, const auto& forces) {
                               contact_dynamics(r, s, x, rates, forces);
                               return centre_of_pressure(r, s, of);
                             });
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte {

KTE_FUNCTION double support_polygon_result::area() const {
  double twice = 0;
  for (std::size_t i = 2; i < corners.size(); ++i)
    twice += dot(normal, cross(corners[i - 1] - corners[0], corners[i] - corners[0]));
  return twice / 2;
}
KTE_FUNCTION double support_polygon_result::margin(const vec3<>& point) const {
  const auto size = [](const vec3<>& x) { return std::sqrt(dot(x, x)); };
  const vec3<> p = point - dot(normal, point - corners[0]) * normal;
  bool inside = corners.size() > 2;
  double nearest = size(p - corners[0]);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const vec3<>& from = corners[i];
    const vec3<> along = corners[(i + 1) % corners.size()] - from;
    const double length = dot(along, along);
    const double part = length > 0 ? (std::min)((std::max)(dot(p - from, along) / length, 0.0), 1.0) : 0;
    nearest = (std::min)(nearest, size(p - from - part * along));
    inside = inside && dot(normal, cross(along, p - from)) >= 0;
  }
  return inside ? nearest : -nearest;
}

}  // namespace kte

namespace kte::detail {

/// Chosen contacts on one plane: their points on it. Throws `bad_argument`, `no_solution`.
struct points_on_plane {
  support_polygon_result polygon;
  std::vector<vec3<>> points;
  std::vector<int> slots;

  points_on_plane(const runtime_chain& c, runtime_state& s, const chosen_contacts& of) {
    const auto chosen = place_contacts(c, s, of, false);
    const auto& m = contact_memory(c, s);
    if (chosen.empty()) throw no_solution("kte: no contact touches");
    const contact_at& first = m.contacts[static_cast<std::size_t>(chosen[0])];
    polygon.normal = first.place.normal;
    for (const int i : chosen) {
      const contact_at& x = m.contacts[static_cast<std::size_t>(i)];
      const auto& name = m.result.names[static_cast<std::size_t>(i)];
      const auto refuse = [&](const char* why) {
        throw bad_argument("kte: contacts '" + polygon.contacts.front() + "' and '" + name + "' are " + why +
                           ": a support polygon is of contacts with one plane");
      };
      const vec3<> p = x.place.point - x.place.gap * x.place.normal;
      if (!points.empty()) {
        const auto &a = m.place(first).frame1, &b = m.place(x).frame1;
        if (a.what != b.what || a.index != b.index) refuse("on different frames");
        const vec3<> turn = cross(polygon.normal, x.place.normal);
        if (!(dot(turn, turn) < 1e-18) || !(dot(polygon.normal, x.place.normal) > 0) ||
            !(std::abs(dot(polygon.normal, p - points.front())) <= touching_gap * m.equations.places.length))
          refuse("not on one plane");
      }
      polygon.contacts.push_back(name), points.push_back(p), slots.push_back(x.slot);
    }
  }
};
/// Andrew's monotone chain, of points in coordinates along two tangents.
KTE_FUNCTION support_polygon_result support_polygon_at_state(const runtime_chain& c, runtime_state& s,
                                                             const chosen_contacts& of) {
  points_on_plane found(c, s, of);
  support_polygon_result& r = found.polygon;
  const auto basis = basis_at(r.normal, false);
  auto& all = found.points;
  const auto by = [&basis](const vec3<>& p, std::size_t k) { return dot(basis[k], p); };
  std::sort(all.begin(), all.end(), [&by](const vec3<>& a, const vec3<>& b) {
    return by(a, 1) < by(b, 1) || (by(a, 1) == by(b, 1) && by(a, 2) < by(b, 2));
  });
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const double size = [&all] {
    const vec3<> d = all.back() - all.front();
    return dot(d, d);
  }();
  auto& hull = r.corners;
  const auto add = [&](const vec3<>& p, std::size_t least) {
    while (hull.size() >= least &&
           !(dot(r.normal, cross(hull.back() - hull[hull.size() - 2], p - hull.back())) > 1e-14 * size))
      hull.pop_back();
    hull.push_back(p);
  };
  for (const auto& p : all) add(p, 2);
  const std::size_t lower = hull.size() + 1;
  for (std::size_t i = all.size() - 1; i-- > 0;) add(all[i], lower);
  if (all.size() > 1) hull.pop_back();
  return r;
}
KTE_FUNCTION vec3<> centre_of_pressure_at_state(const runtime_chain& c, runtime_state& s, const chosen_contacts& of) {
  const points_on_plane found(c, s, of);
  vec3<> sum{};
  double all = 0;
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    const double force = dot(found.polygon.normal, s.get<kind::contact>(found.slots[i]).force);
    sum = sum + force * found.points[i], all += force;
  }
  if (!(all > 0)) throw no_solution("kte: no contact has a normal force, so there is no centre of pressure");
  return (1 / all) * sum;
}

}  // namespace kte::detail
#endif
