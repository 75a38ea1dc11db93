#pragma once

#include <kte/robots/detail/urdf_link.hpp>

namespace kte::detail {

/// The types of <kte:loop>; the first of several names is written.
struct urdf_loop_type {
  std::string_view name;
  robot_closure::kind is;
};
inline constexpr urdf_loop_type urdf_loop_types[]{
    {"hinge", robot_closure::kind::hinge},         {"revolute", robot_closure::kind::hinge},
    {"continuous", robot_closure::kind::hinge},    {"ball", robot_closure::kind::points},
    {"spherical", robot_closure::kind::points},    {"fixed", robot_closure::kind::frames},
    {"universal", robot_closure::kind::universal}, {"cylindrical", robot_closure::kind::cylindrical},
    {"sliding", robot_closure::kind::sliding},     {"prismatic", robot_closure::kind::sliding},
    {"line", robot_closure::kind::point_on_line},  {"plane", robot_closure::kind::point_on_plane},
    {"distance", robot_closure::kind::distance},   {"joints", robot_closure::kind::joints}};

/// <kte:loop>, an extension of URDF: a closure between frames of two links,
///
///   <kte:loop name="pin" type="hinge">
///     <link1 link="coupler" xyz="1.1 0 0" rpy="0 0 0"/>
///     <link2 link="rocker" xyz="0.8 0 0" rpy="0 0 0"/>
///     <axis xyz="0 0 1"/>
///   </kte:loop>
///
/// or between two joints, <kte:loop name="gear" type="joints" polynomial="0 -2"> <joint1 joint="a"/> <joint2
/// joint="b"/>
/// </kte:loop>: q_a = 0 - 2 q_b.
inline robot_closure read_urdf_loop(const xml_item& x, const urdf_links& links) {
  using kind = robot_closure::kind;
  robot_closure c;
  c.name = x.text("name"), c.line = x.line(), c.file = x.file();
  const auto type = x.text("type");
  const auto known = std::find_if(std::begin(urdf_loop_types), std::end(urdf_loop_types),
                                  [&](const auto& t) { return t.name == type; });
  if (known == std::end(urdf_loop_types)) {
    std::string all;
    for (const auto& t : urdf_loop_types) all.append(all.empty() ? "" : ", ").append(t.name);
    x.fail("type '" + excerpt(type) + "' is none of " + all);
  }
  c.is = known->is;
  if (c.is == kind::joints) {
    x.only({"joint1", "joint2"}, {"name", "type", "polynomial"});
    c.link1 = x.needed_child("joint1").text("joint"), c.link2 = x.needed_child("joint2").text("joint");
    const auto p = x.list("polynomial");
    if (p.size() > c.polynomial.size()) x.fail("polynomial has at most five numbers, got " + std::to_string(p.size()));
    std::copy(p.begin(), p.end(), c.polynomial.begin());
    return c;
  }
  x.only({"link1", "link2", "axis", "axis2"}, {"name", "type", "length"});
  const auto end = [&](const char* of, std::string& link, robot_pose& origin) {
    const auto e = x.needed_child(of);
    e.only({}, {"link", "xyz", "rpy"});
    link = e.text("link"), origin = links.pose(e);
  };
  end("link1", c.link1, c.origin1), end("link2", c.link2, c.origin2);
  const auto axis = [&](const char* of, vec3<>& n) {
    if (const auto a = x.child(of)) n = unit_axis(*a, a->vector("xyz"));
  };
  axis("axis", c.axis), axis("axis2", c.axis2);
  if (c.is == kind::distance) {
    c.length = x.number("length");
    if (!(c.length > 0)) x.fail("length must be greater than 0, got " + number(c.length));
  }
  return c;
}

}  // namespace kte::detail
