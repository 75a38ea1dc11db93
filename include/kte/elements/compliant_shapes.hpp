#pragma once

#include <kte/contact/shape_points.hpp>
#include <kte/elements/compliant_contact.hpp>
#include <kte/static_chain/static_chain.hpp>

/// Compliant contacts of capsules and boxes: several elements, one for each end or corner.
namespace kte {

namespace detail {
template <kind Dim, class A, class B, class Surface, std::size_t N>
constexpr auto compliant_spheres(const A& frame1, const B& frame2, const Surface& surface, double radius,
                                 const std::array<vec3<>, N>& at, const compliant_contact_parameters& p) {
  const auto one = [&](std::size_t k) {
    return compliant<Dim>(sphere_on<Dim>(surface, radius, at[k]), frame1, frame2, p);
  };
  return [&]<std::size_t... K>(std::index_sequence<K...>) {
    if constexpr (is_element<decltype(one(0))>)
      return make_chain(one(K)...);
    else
      return together(one(K)...);
  }
  (std::make_index_sequence<N>{});
}
}  // namespace detail

/// The compliant contact of a surface of frame1 with a capsule about the origin of frame2, in the plane: two contacts,
/// of circles of a radius, m, about the points `half` and -`half` of frame2, m. Its sides touch only what is flat.
template <class A, class B, class Surface, class Half, entry Radius>
[[nodiscard]] constexpr auto compliant_capsule_contact_2D(const A& frame1, const B& frame2, const Surface& surface,
                                                          const Half& half, const Radius& radius,
                                                          const compliant_contact_parameters& p) {
  return detail::compliant_spheres<kind::frame_2D>(frame1, frame2, surface, as<double>(radius),
                                                   detail::ends_of(as<double>(detail::planar(half))), p);
}
/// The compliant contact of a surface of frame1 with a capsule about the origin of frame2, in space: two contacts, of
/// spheres of a radius, m, about the points `half` and -`half` of frame2, m. Its sides touch only what is flat.
template <class A, class B, class Surface, class X, class Y, class Z, entry Radius>
[[nodiscard]] constexpr auto compliant_capsule_contact_3D(const A& frame1, const B& frame2, const Surface& surface,
                                                          const vec3<X, Y, Z>& half, const Radius& radius,
                                                          const compliant_contact_parameters& p) {
  return detail::compliant_spheres<kind::frame_3D>(frame1, frame2, surface, as<double>(radius),
                                                   detail::ends_of(as<double>(half)), p);
}
/// The compliant contact of a surface of frame1 with a rectangle about the origin of frame2: four contacts, of its
/// corners; `half` are half its lengths along x and y, m. Its sides touch only what is flat.
template <class A, class B, class Surface, class Half>
[[nodiscard]] constexpr auto compliant_box_contact_2D(const A& frame1, const B& frame2, const Surface& surface,
                                                      const Half& half, const compliant_contact_parameters& p) {
  return detail::compliant_spheres<kind::frame_2D>(frame1, frame2, surface, 0,
                                                   detail::corners_2D(as<double>(detail::planar(half))), p);
}
/// The compliant contact of a surface of frame1 with a box about the origin of frame2: eight contacts, of its corners;
/// `half` are half its lengths along x, y, z, m. Its edges and faces touch only what is flat.
template <class A, class B, class Surface, class X, class Y, class Z>
[[nodiscard]] constexpr auto compliant_box_contact_3D(const A& frame1, const B& frame2, const Surface& surface,
                                                      const vec3<X, Y, Z>& half,
                                                      const compliant_contact_parameters& p) {
  return detail::compliant_spheres<kind::frame_3D>(frame1, frame2, surface, 0, detail::corners_3D(as<double>(half)), p);
}

KTE_CALL(compliant_capsule_contact_2D, "(frame1, frame2, surface, half, radius, parameters)")
KTE_CALL(compliant_capsule_contact_3D, "(frame1, frame2, surface, half, radius, parameters)")
KTE_CALL(compliant_box_contact_2D, "(frame1, frame2, surface, half, parameters)")
KTE_CALL(compliant_box_contact_3D, "(frame1, frame2, surface, half, parameters)")

}  // namespace kte
