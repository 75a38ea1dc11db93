#pragma once

#include <kte/robots/detail/read_values.hpp>

#include <map>

namespace kte::detail {

/// The number between the tags of a child, or another.
inline double child_number(const xml_item& x, const char* of, double other) {
  const auto c = x.child(of);
  return c ? c->one(c->list_of(c->content(), of), of) : other;
}
inline double child_limit(const xml_item& x, const char* of, double other) {
  const auto c = x.child(of);
  if (!c) return other;
  const double value = c->one(c->limits_of(c->content(), of), of);
  if (std::isnan(value)) c->fail("is not a number");
  return value;
}
inline vec3<> child_vector(const xml_item& x, const char* of) {
  const auto c = x.needed_child(of);
  return c.three(c.list_of(c.content(), of), of);
}
inline std::string child_text(const xml_item& x, const char* of) {
  const auto c = x.needed_child(of);
  std::string_view t = c.content();
  while (!t.empty() && is_blank(t.front())) t.remove_prefix(1);
  while (!t.empty() && is_blank(t.back())) t.remove_suffix(1);
  if (t.empty()) c.fail("is empty");
  return std::string(t);
}

/// The <pose> of something: "x y z roll pitch yaw", in radians or degrees, or with a quaternion x y z w.
inline robot_pose sdf_pose(const xml_item& owner, const robot_options& o) {
  const auto x = owner.child("pose");
  if (!x || x->content().find_first_not_of(" \t\r\n") == std::string::npos) return {};
  const auto p = x->list_of(x->content(), "pose");
  const auto format = x->text_or("rotation_format", "euler_rpy");
  const bool quaternion = format == "quat_xyzw";
  if (!quaternion && format != "euler_rpy") x->fail("rotation_format '" + excerpt(format) + "' is not known");
  if (p.size() != (quaternion ? 7U : 6U))
    x->fail("must have " + std::string(quaternion ? "seven" : "six") + " numbers, got " + std::to_string(p.size()));
  const vec3<> at{p[0], p[1], p[2]};
  if (quaternion) return {at, rotation_of_quaternion(*x, {p[6], p[3], p[4], p[5]})};
  const double unit = x->text_or("degrees", "false") == "true" ? std::numbers::pi / 180 : 1;
  const vec3<> rpy{p[3] * unit, p[4] * unit, p[5] * unit};
  for (const double angle : {rpy.x, rpy.y, rpy.z}) note_near_quarter(*x, angle, o);
  return {at, rotation_of_rpy(rpy, o.quarter_turn_tolerance)};
}

/// The frames of a model in SDF: of links, joints, and others, each relative to another. The model's own is
/// "__model__".
class sdf_frames {
 public:
  void add(const xml_item& x, const std::string& name, const std::string& relative_to, const robot_pose& pose) {
    if (!frames_.emplace(name, frame{relative_to, pose, x}).second) x.fail("there is another frame of this name");
  }
  /// Where `to` stands in `from`: as it is written, if it is.
  robot_pose relative(const xml_item& asks, const std::string& from, const std::string& to) const {
    if (from == to) return {};
    if (const auto it = frames_.find(to); it != frames_.end() && it->second.relative_to == from) return it->second.pose;
    if (const auto it = frames_.find(from); it != frames_.end() && it->second.relative_to == to)
      return inverse_of(it->second.pose);
    return inverse_of(in_model(asks, from)) * in_model(asks, to);
  }

 private:
  struct frame {
    std::string relative_to;
    robot_pose pose;
    xml_item from;
  };
  robot_pose in_model(const xml_item& asks, const std::string& name) const {
    robot_pose all;
    std::string at = name;
    for (std::size_t steps = 0; at != "__model__"; ++steps) {
      const auto it = frames_.find(at);
      if (it == frames_.end()) asks.fail("there is no frame '" + excerpt(at) + "'");
      if (steps > frames_.size()) it->second.from.fail("its pose is relative to itself, in the end");
      all = it->second.pose * all, at = it->second.relative_to;
    }
    return all;
  }
  std::map<std::string, frame, std::less<>> frames_;
};

}  // namespace kte::detail
