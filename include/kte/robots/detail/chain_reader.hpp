#pragma once

#include <kte/robots/detail/physical.hpp>
#include <kte/robots/robot.hpp>

#include <map>
#include <set>
#include <unordered_map>

namespace kte::detail {

/// Reads the links and joints of a chain from the records of its elements.
class chain_reader {
 public:
  chain_reader(const runtime_chain& c, const std::string& name) : record_(record_of(c)) {
    d_.name = name, d_.source = "chain of '" + name + "'";
    const auto& g = record_.gravity;
    d_.gravity = vec3<>{g[0], g[1], g[2]};
  }
  robot_description read() {
    for (const auto& e : record_.elements)
      if (!frame(e)) forces_.push_back(&e);
    for (const auto* e : forces_) force(*e);
    name_fixed();
    return std::move(d_);
  }

 private:
  using kind = robot_joint::kind;

  [[noreturn]] static void refuse(const element_record& e, const std::string& why) {
    std::string text = "kte: " + e.type + " (";
    for (const auto& c : e.connections) text += (&c == e.connections.data() ? "" : ", ") + c.role + " '" + c.name + "'";
    raise<bad_argument>(text + "): " + why);
  }
  static const std::string& to(const element_record& e, std::string_view role) {
    for (const auto& c : e.connections)
      if (c.role == role) return c.name;
    refuse(e, "has no " + std::string(role));
  }
  static std::vector<double> numbers(const element_record& e, std::string_view name) {
    for (const auto& p : e.parameters)
      if (p.name == name) return p.values;
    return {};
  }
  static double number(const element_record& e, std::string_view name) {
    const auto x = numbers(e, name);
    return x.empty() ? 0 : x[0];
  }
  static vec3<> vector(const element_record& e, std::string_view name) {
    const auto x = numbers(e, name);
    return x.size() == 3 ? vec3<>{x[0], x[1], x[2]} : vec3<>{};
  }
  static robot_pose place(const element_record& e) {
    robot_pose p;
    p.position = vector(e, "position");
    if (const auto r = numbers(e, "rotation"); r.size() == 9)
      p.rotation = {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
    return p;
  }
  robot_link& link(const std::string& name) {
    const auto [known, fresh] = links_.emplace(name, d_.links.size());
    if (fresh) d_.links.emplace_back().name = name;
    return d_.links[known->second];
  }

  /// Reads a link, a joint or a body; false for other elements.
  bool frame(const element_record& e) {
    static const std::map<std::string, kind, std::less<>> joints{
        {"rigid_link_3D", kind::fixed},          {"revolute_joint_3D", kind::revolute},
        {"prismatic_joint_3D", kind::prismatic}, {"spherical_joint_3D", kind::spherical},
        {"planar_joint_3D", kind::planar},       {"free_joint_3D", kind::floating},
        {"screw_joint_3D", kind::screw}};
    if (e.type == "base_3D") return link(to(e, "base")), true;
    if (e.type == "inertia_3D") return body(e), true;
    const auto is = joints.find(e.type);
    if (is == joints.end()) return false;
    robot_joint j;
    j.is = is->second, j.origin = place(e), j.parent = to(e, "base"), j.child = to(e, "end");
    j.continuous = j.is == kind::revolute;
    if (has_one_coordinate(j)) j.axis = vector(e, "axis"), j.pitch = number(e, "pitch");
    if (j.is == kind::planar) j.axis = {0, 0, 1};
    if (j.is != kind::fixed) {
      j.name = to(e, "coordinate");
      if (!joints_.emplace(j.name, d_.joints.size()).second)
        refuse(e, "its coordinate '" + j.name + "' moves another joint too: links and joints cannot say that");
    }
    link(j.parent), link(j.child);
    d_.joints.push_back(std::move(j));
    return true;
  }
  void body(const element_record& e) {
    const auto i = numbers(e, "inertia");
    rigid_body<> b{number(e, "mass"), vector(e, "com"), {}};
    if (i.size() == 6) b.inertia = {i[0], i[1], i[2], i[3], i[4], i[5]};
    auto& l = link(to(e, "frame"));
    l.inertial = l.inertial ? together(*l.inertial, b) : b;
  }

  robot_joint& joint(const element_record& e, const std::string& coordinate) {
    const auto it = joints_.find(coordinate);
    if (it == joints_.end()) refuse(e, "its coordinate '" + coordinate + "' does not belong to a joint");
    return d_.joints[it->second];
  }
  /// The joint of a spring or damper between a coordinate and its rest value.
  robot_joint& joint_from_rest(const element_record& e) {
    if (!rest_.contains(to(e, "anchor1"))) refuse(e, "its anchor1 is not at rest: links and joints cannot say that");
    return joint(e, to(e, "anchor2"));
  }
  void motor(const element_record& e) {
    const auto n = [&](const char* name) { return number(e, name); };
    d_.actuators.push_back({to(e, "command"),
                            0,
                            joint(e, to(e, "coordinate")).name,
                            1,
                            {n("gain"), n("offset"), n("stiffness"), n("damping"), n("lower"), n("upper"),
                             n("lower_command"), n("upper_command")}});
  }
  static void spring(const element_record& e, robot_joint& j, double rest) {
    auto& x = j.dynamics;
    if (x.stiffness != 0 || x.stiffness_powers != robot_joint_dynamics::powers{})
      refuse(e, "its joint has a spring already");
    x.stiffness = number(e, "stiffness"), x.rest = rest;
    x.stiffness_powers = {number(e, "quadratic"), number(e, "cubic")};
  }
  void force(const element_record& e) {
    if (e.type == "base_gen") {
      rest_.insert(to(e, "base"));
    } else if (e.type == "mimic_gen") {
      joint(e, to(e, "end")).mimic = {to(e, "base"), number(e, "ratio"), number(e, "offset")};
    } else if (e.type == "joint_damping_gen" || e.type == "joint_cubic_damping_gen") {
      auto& x = joint(e, to(e, "coordinate")).dynamics;
      x.damping += number(e, "damping");
      x.damping_powers.quadratic += number(e, "quadratic"), x.damping_powers.cubic += number(e, "cubic");
    } else if (e.type == "damper_gen") {
      joint_from_rest(e).dynamics.damping += number(e, "damping");
    } else if (e.type == "joint_stiffness_gen" || e.type == "joint_cubic_stiffness_gen") {
      spring(e, joint(e, to(e, "coordinate")), number(e, "rest"));
    } else if (e.type == "spring_gen") {
      if (number(e, "saturation") != 0) refuse(e, "it saturates: links and joints cannot say that");
      spring(e, joint_from_rest(e), number(e, "rest_length"));
    } else if (e.type == "inertia_gen") {
      joint(e, to(e, "coordinate")).dynamics.armature += number(e, "mass");
    } else if (e.type == "joint_motor_gen") {
      motor(e);
    } else if (e.type == "joint_friction_gen") {
      if (number(e, "stiction") != 0) refuse(e, "it has stiction: links and joints cannot say that");
      auto& x = joint(e, to(e, "coordinate")).dynamics;
      x.damping += number(e, "viscous"), x.friction += number(e, "coulomb");
      const double rate = number(e, "smoothing_velocity");
      if (number(e, "coulomb") != 0 && rate != robot_options{}.friction_smoothing)
        d_.not_read.push_back({0, "joint '" + to(e, "coordinate") +
                                      "': a description has no rate over which friction changes its sign, here " +
                                      detail::number(rate)});
    } else if (!closure(e) && !free_turning(e) && !compensation(e)) {
      refuse(e, "it is not a link, joint, body or closure in space, or damping or friction of a joint");
    }
  }
  /// Whether it closes a loop.
  bool closure(const element_record& e) {
    using closure_kind = robot_closure::kind;
    static const std::map<std::string, closure_kind> closures{{"coincident_points_3D", closure_kind::points},
                                                              {"coincident_frames_3D", closure_kind::frames},
                                                              {"hinge_3D", closure_kind::hinge},
                                                              {"universal_3D", closure_kind::universal},
                                                              {"cylindrical_3D", closure_kind::cylindrical},
                                                              {"sliding_3D", closure_kind::sliding},
                                                              {"point_on_line_3D", closure_kind::point_on_line},
                                                              {"point_on_plane_3D", closure_kind::point_on_plane},
                                                              {"distance_3D", closure_kind::distance},
                                                              {"coupled_coordinates", closure_kind::joints},
                                                              {"coupled_by_polynomial", closure_kind::joints}};
    const auto is = closures.find(e.type);
    if (is == closures.end()) return false;
    robot_closure c;
    c.name = to(e, "loop"), c.is = is->second;
    if (c.is == closure_kind::joints) {
      c.link1 = joint(e, to(e, "coordinate1")).name, c.link2 = joint(e, to(e, "coordinate2")).name;
      c.polynomial = {number(e, "c0"), number(e, "c1"), number(e, "c2"), number(e, "c3"), number(e, "c4")};
      if (e.type == "coupled_coordinates") {
        if (number(e, "factor1") == 0) refuse(e, "its factor1 is 0: a polynomial of the second joint cannot say that");
        c.polynomial = {number(e, "constant") / number(e, "factor1"),
                        0.0 - number(e, "factor2") / number(e, "factor1")};
      }
    } else {
      c.link1 = to(e, "frame1"), c.link2 = to(e, "frame2"), c.length = number(e, "length");
      for (const char* name : {"axis", "axis1", "normal"})
        if (!numbers(e, name).empty()) c.axis = vector(e, name);
      if (!numbers(e, "axis2").empty()) c.axis2 = vector(e, "axis2");
    }
    d_.closures.push_back(std::move(c));
    return true;
  }
  /// Whether it is a spring or damper of a ball, or the damping of a free body: a torque, and then a force.
  bool free_turning(const element_record& e) {
    const bool drag = e.type == "fluid_drag_3D", spring = e.type == "torsion_spring_3D";
    if (!drag && !spring && e.type != "torsion_damper_3D") return false;
    auto* const above = joint_to(to(e, drag ? "frame" : "anchor2"));
    if (above == nullptr) return false;
    auto& j = *above;
    const bool free = j.is == kind::floating;
    if (drag)
      return free && number(e, "quadratic") == 0 && vector(e, "flow") == vec3<>{} &&
             number(e, "linear") == j.dynamics.damping;
    if ((j.is != kind::spherical && !free) || j.parent != to(e, "anchor1")) return false;
    if (!spring) return j.dynamics.damping += number(e, "damping"), true;
    if (free || number(e, "saturation") != 0 || place_of_rest(e) != j.origin.rotation) return false;
    return j.dynamics.stiffness += number(e, "stiffness"), true;
  }
  static mat3<vec3<>> place_of_rest(const element_record& e) {
    const auto r = numbers(e, "rest_rotation");
    if (r.size() != 9) return robot_pose{}.rotation;
    return {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
  }
  /// Reads a force that compensates the weight of a link at its centre of mass; false for other elements.
  bool compensation(const element_record& e) {
    if (e.type != "constant_force_3D" || vector(e, "torque") != vec3<>{}) return false;
    const auto at = to(e, "frame");
    const auto force = vector(e, "force"), g = *d_.gravity;
    const auto bears = [&](robot_link& l, const vec3<>& centre) {
      if (!l.inertial || !(l.inertial->mass > 0) || l.inertial->com != centre) return false;
      const double weight = l.inertial->mass * dot(g, g), k = weight > 0 ? 0.0 - dot(force, g) / weight : 0;
      const vec3<> off = force + (k * l.inertial->mass) * g;
      if (!(weight > 0) || dot(off, off) > 1e-30 * dot(force, force)) return false;
      return l.gravity_compensation += k, true;
    };
    // The frame is that of the link, or one fixed to it.
    const auto own = links_.find(at);
    if (own != links_.end() && bears(d_.links[own->second], {})) return true;
    const auto* const j = joint_to(at);
    return j != nullptr && j->is == kind::fixed && bears(d_.links[links_.find(j->parent)->second], j->origin.position);
  }
  /// The joint or link that moves a frame; null: there is none.
  robot_joint* joint_to(const std::string& frame) {
    if (above_.empty())
      for (std::size_t i = 0; i < d_.joints.size(); ++i) above_.emplace(d_.joints[i].child, i);
    const auto known = above_.find(frame);
    return known == above_.end() ? nullptr : &d_.joints[known->second];
  }
  /// Names the fixed joints, which have no coordinate to give them a name.
  void name_fixed() {
    for (auto& j : d_.joints) {
      if (j.is != kind::fixed) continue;
      j.name = j.child + "_fixed";
      while (!joints_.emplace(j.name, 0).second) j.name += '_';
    }
  }

  model_record record_;
  robot_description d_;
  std::map<std::string, std::size_t, std::less<>> links_, joints_;
  std::unordered_map<std::string, std::size_t> above_;  ///< joints by the frames that they move
  std::set<std::string, std::less<>> rest_;
  std::vector<const element_record*> forces_;
};

}  // namespace kte::detail
