#pragma once

#include <kte/robots/detail/contact_leftovers.hpp>
#include <kte/robots/detail/sdf_values.hpp>

#include <charconv>

namespace kte::detail {

/// The bit mask between the tags of an element, decimal or as 0xff; without a text the default 0xffff.
inline std::uint32_t bit_mask(const xml_item& x) {
  const auto text = trimmed_content(x);
  std::string_view digits = text;
  const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
  if (hexadecimal) digits.remove_prefix(2);
  std::uint32_t bits = 0xFFFF;
  if (text.empty()) return bits;
  const auto* const end = digits.data() + digits.size();
  const auto [stop, code] = std::from_chars(digits.data(), end, bits, hexadecimal ? 16 : 10);
  if (code != std::errc{} || stop != end)
    x.fail("'" + excerpt(text) + "' is not a whole number of 32 bits, such as 255 or 0xff");
  return bits;
}

/// Reads the <surface> of a <collision>: friction, restitution, and what it collides with.
inline void read_sdf_surface(const xml_item& x, robot_touch& t, contact_leftovers& left) {
  const auto number = [](const xml_item& in, const char* of) {
    const double value = child_number(in, of, 1);
    if (!(value >= 0)) in.fail(std::string(of) + " must not be negative, got " + detail::number(value));
    return value;
  };
  for (const auto& part : x.children())
    for (const auto& c : part.children()) {
      if (part.name() == "friction" && c.name() == "ode") {
        t.friction = number(c, "mu");
        if (filled_child(c, "mu2") && number(c, "mu2") != *t.friction) left.add(x, "mu2 other than mu");
        for (const auto& y : c.children())
          if (y.name() != "mu" && y.name() != "mu2") left.add(x, y.name());
      } else if (part.name() == "bounce" && c.name() == "restitution_coefficient") {
        t.restitution = child_number(part, "restitution_coefficient", 0);
      } else if (part.name() == "contact" && c.name() == "collide_bitmask") {
        t.type = t.affinity = bit_mask(c);
      } else if (part.name() == "contact" && c.name() == "collide_without_contact") {
        if (child_flag(part, "collide_without_contact", false)) t.type = t.affinity = 0;
      } else {
        left.add(x, std::string(part.name()) + "/" + std::string(c.name()));
      }
    }
}

/// The normal of the plane of a <collision> or <visual>.
inline vec3<> plane_normal(const xml_item& x) {
  const auto geometry = first_child(x, "geometry");
  const auto plane = geometry ? first_child(*geometry, "plane") : std::nullopt;
  return plane ? unit_direction(*plane, child_vector(*plane, "normal", {0, 0, 1})) : vec3<>{0, 0, 1};
}

}  // namespace kte::detail
