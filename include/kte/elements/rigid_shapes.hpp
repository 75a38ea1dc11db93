#pragma once

#include <kte/contact/shape_points.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/static_chain/static_chain.hpp>

#include <string>

/// Rigid contacts of capsules and boxes: several elements, one for each end or corner, each with its own name.
namespace kte {

/// The key of a part of a contact: "crate/corner 3" of "crate". `what`, `text` and `name` are the members of a key.
template <key_type Contact, fixed_string Part, std::size_t K>
struct contact_part_key {
  static_assert(K > 0 && K < 10);
  static constexpr kind what = Contact::what;
  static constexpr auto text = [] {
    constexpr std::string_view part = Part.view();
    std::array<char, Contact::name.size() + part.size() + 3> all{};
    auto end = std::copy(Contact::name.begin(), Contact::name.end(), all.begin());
    *end++ = '/';
    end = std::copy(part.begin(), part.end(), end);
    *end++ = ' ', *end = static_cast<char>('0' + K);
    return all;
  }();
  static constexpr std::string_view name{text.data(), text.size()};
};
/// The name of contact K, from 1 to 8, of a `box_contact`: "crate/corner 3" for `corner_of<3>(crate)`. With the sides
/// of x, y, z as digits 0 (negative) and 1 of the binary number zyx, K is that number plus 1; in the plane K counts
/// counterclockwise from x, y > 0.
template <std::size_t K, class Contact>
[[nodiscard]] constexpr auto corner_of(const Contact& contact);
/// The name of contact K, 1 or 2, of a `capsule_contact`: "leg/end 1" for `end_of<1>(leg)`, at `half`.
template <std::size_t K, class Contact>
[[nodiscard]] constexpr auto end_of(const Contact& contact);

namespace detail {
template <fixed_string Part, std::size_t K, class Contact>
constexpr auto contact_part(const Contact& contact) {
  if constexpr (key_type<Contact>)
    return contact_part_key<Contact, Part, K>{};
  else if constexpr (text_type<Contact>)
    return std::string(std::string_view(contact)).append("/").append(Part.view()).append(" ") + std::to_string(K);
  else
    return contact;  // rejected by `connect`
}
/// The contacts as part of a chain, which declares their frames.
template <kind Dim, fixed_string Part, class C, class A, class B, class Surface, std::size_t N>
constexpr auto rigid_spheres(const C& contact, const A& frame1, const B& frame2, const Surface& surface, double radius,
                             const std::array<vec3<>, N>& at, const contact_law& law) {
  return [&]<std::size_t... K>(std::index_sequence<K...>) {
    const auto one = [&]<std::size_t I>(std::integral_constant<std::size_t, I>) {
      return touching<Dim>(sphere_on<Dim>(surface, radius, at[I]), contact_part<Part, I + 1>(contact), frame1, frame2,
                           law);
    };
    if constexpr ((is_element<decltype(one(std::integral_constant<std::size_t, K>{}))> && ...))
      return make_chain(one(std::integral_constant<std::size_t, K>{})...);
    else
      return together(one(std::integral_constant<std::size_t, K>{})...);
  }
  (std::make_index_sequence<N>{});
}
}  // namespace detail

template <std::size_t K, class Contact>
constexpr auto corner_of(const Contact& contact) {
  return detail::contact_part<"corner", K>(contact);
}
template <std::size_t K, class Contact>
constexpr auto end_of(const Contact& contact) {
  return detail::contact_part<"end", K>(contact);
}

/// The rigid contact of a surface of frame1 with a capsule about the origin of frame2, in the plane: two contacts, of
/// circles of a radius, m, about the points `half` and -`half` of frame2, m. Its sides touch only what is flat.
template <class C, class A, class B, class Surface, class Half, entry Radius>
[[nodiscard]] constexpr auto capsule_contact_2D(const C& contact, const A& frame1, const B& frame2,
                                                const Surface& surface, const Half& half, const Radius& radius,
                                                const contact_law& law) {
  return detail::rigid_spheres<kind::frame_2D, "end">(contact, frame1, frame2, surface, as<double>(radius),
                                                      detail::ends_of(as<double>(detail::planar(half))), law);
}
/// The rigid contact of a surface of frame1 with a capsule about the origin of frame2, in space: two contacts, of
/// spheres of a radius, m, about the points `half` and -`half` of frame2, m, named "leg/end 1" and "leg/end 2" for the
/// contact "leg". Its sides touch only what is flat.
template <class C, class A, class B, class Surface, class X, class Y, class Z, entry Radius>
[[nodiscard]] constexpr auto capsule_contact_3D(const C& contact, const A& frame1, const B& frame2,
                                                const Surface& surface, const vec3<X, Y, Z>& half, const Radius& radius,
                                                const contact_law& law) {
  return detail::rigid_spheres<kind::frame_3D, "end">(contact, frame1, frame2, surface, as<double>(radius),
                                                      detail::ends_of(as<double>(half)), law);
}
/// The rigid contact of a surface of frame1 with a rectangle about the origin of frame2: four contacts, of its corners;
/// `half` are half its lengths along x and y, m. Its sides touch only what is flat.
template <class C, class A, class B, class Surface, class Half>
[[nodiscard]] constexpr auto box_contact_2D(const C& contact, const A& frame1, const B& frame2, const Surface& surface,
                                            const Half& half, const contact_law& law) {
  return detail::rigid_spheres<kind::frame_2D, "corner">(contact, frame1, frame2, surface, 0,
                                                         detail::corners_2D(as<double>(detail::planar(half))), law);
}
/// The rigid contact of a surface of frame1 with a box about the origin of frame2: eight contacts, of its corners,
/// named "crate/corner 1" to "crate/corner 8" for the contact "crate" (`corner_of`); `half` are half its lengths along
/// x, y, z, m. Its edges and faces touch only what is flat.
template <class C, class A, class B, class Surface, class X, class Y, class Z>
[[nodiscard]] constexpr auto box_contact_3D(const C& contact, const A& frame1, const B& frame2, const Surface& surface,
                                            const vec3<X, Y, Z>& half, const contact_law& law) {
  return detail::rigid_spheres<kind::frame_3D, "corner">(contact, frame1, frame2, surface, 0,
                                                         detail::corners_3D(as<double>(half)), law);
}

KTE_CALL(capsule_contact_2D, "(contact, frame1, frame2, surface, half, radius, law)")
KTE_CALL(capsule_contact_3D, "(contact, frame1, frame2, surface, half, radius, law)")
KTE_CALL(box_contact_2D, "(contact, frame1, frame2, surface, half, law)")
KTE_CALL(box_contact_3D, "(contact, frame1, frame2, surface, half, law)")

}  // namespace kte
