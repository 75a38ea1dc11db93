#pragma once

#include <kte/robots/detail/read_values.hpp>

/// Reads the text between tags of SDF; an empty text stands for the default of the format.
namespace kte::detail {

/// The text without blanks at its ends.
inline std::string_view trimmed(std::string_view t) {
  while (!t.empty() && is_blank(t.front())) t.remove_prefix(1);
  while (!t.empty() && is_blank(t.back())) t.remove_suffix(1);
  return t;
}
inline std::string_view trimmed_content(const xml_item& x) { return trimmed(x.content()); }

/// The first child of a name, if it exists and is not empty.
inline std::optional<xml_item> filled_child(const xml_item& x, const char* of) {
  const auto c = first_child(x, of);
  if (!c || trimmed_content(*c).empty()) return {};
  return c;
}
/// The number in a child, or `other` without it.
inline double child_number(const xml_item& x, const char* of, double other) {
  const auto c = filled_child(x, of);
  return c ? c->one(c->list_of(c->content(), of), of) : other;
}
inline double child_limit(const xml_item& x, const char* of, double other) {
  const auto c = filled_child(x, of);
  if (!c) return other;
  const double value = c->one(c->limits_of(c->content(), of), of);
  if (std::isnan(value)) c->fail("is not a number");
  return value;
}
inline vec3<> child_vector(const xml_item& x, const char* of, const vec3<>& other) {
  const auto c = filled_child(x, of);
  return c ? c->three(c->list_of(c->content(), of), of) : other;
}
inline std::string child_text(const xml_item& x, const char* of) {
  const auto c = first_child(x, of);
  if (!c) x.fail(std::string("has no <") + of + ">");
  const auto t = trimmed_content(*c);
  if (t.empty()) c->fail("is empty");
  return std::string(t);
}
inline bool flag(const xml_item& x, std::string_view t) {
  if (t == "true" || t == "1" || t == "True" || t == "TRUE") return true;
  if (t != "false" && t != "0" && t != "False" && t != "FALSE")
    x.fail("'" + excerpt(t) + "' is neither true nor false");
  return false;
}
inline bool child_flag(const xml_item& x, const char* of, bool other) {
  const auto c = filled_child(x, of);
  return c ? flag(*c, trimmed_content(*c)) : other;
}

/// Reads the <pose> of an element, in the axes of the frame that it is relative to: "x y z roll pitch yaw" in radians
/// or degrees, or with a quaternion x y z w.
inline robot_pose sdf_pose(const xml_item& owner, const robot_options& o) {
  const auto x = first_child(owner, "pose");
  if (!x) return {};
  x->only({}, {"relative_to", "rotation_format", "degrees"});
  if (trimmed_content(*x).empty()) return {};
  const auto p = x->list_of(x->content(), "pose");
  const auto format = x->text_or("rotation_format", "euler_rpy");
  const bool quaternion = format == "quat_xyzw";
  if (!quaternion && format != "euler_rpy") x->fail("rotation_format '" + excerpt(format) + "' is not known");
  if (p.size() != (quaternion ? 7U : 6U))
    x->fail("must have " + std::string(quaternion ? "seven" : "six") + " numbers, got " + std::to_string(p.size()));
  const vec3<> at{p[0], p[1], p[2]};
  if (quaternion) return {at, rotation_of_quaternion(*x, {p[6], p[3], p[4], p[5]})};
  const double unit = flag(*x, x->text_or("degrees", "false")) ? std::numbers::pi / 180 : 1;
  const vec3<> rpy{p[3] * unit, p[4] * unit, p[5] * unit};
  for (const double angle : {rpy.x, rpy.y, rpy.z}) note_near_quarter(*x, angle, o), note_many_turns(*x, angle);
  return {at, rotation_of_rpy(rpy, o.quarter_turn_tolerance)};
}
/// The frame that the pose is relative to, if it is written.
inline std::string relative_to(const xml_item& owner) {
  const auto pose = owner.children("pose").first();
  return pose ? pose->text_or("relative_to", "") : std::string();
}

}  // namespace kte::detail
