#pragma once

#include <kte/robots/detail/free_names.hpp>
#include <kte/robots/detail/sdf_frames.hpp>

namespace kte::detail {

/// Reads the joints of a model in SDF.
class sdf_joints {
 public:
  sdf_joints(robot_description& d, const sdf_frames& f) : d_(d), frames_(f) {}

  /// Reads the joint of this full name, whose frame is `frame`. The joints that a gearbox couples may come later.
  void read(const xml_item& x, const sdf_scope& scope, const std::string& name, const std::string& frame) {
    look_for_interruption();
    x.only({"parent", "child", "pose", "axis", "axis2", "thread_pitch", "screw_thread_pitch", "physics", "plugin",
            "drake:gear_ratio", "drake:rotor_inertia", "drake:mimic", "drake:controller_gains", "gearbox_ratio",
            "gearbox_reference_body"},
           {"name", "type"});
    if (x.text("type") == "gearbox") return gearboxes_.push_back({x, scope, frame});
    robot_joint j;
    j.name = name, j.line = x.line(), j.file = x.file();
    j.parent = frames_.link_of(x, frames_.find(x, scope, child_text(x, "parent")));
    j.child = frames_.link_of(x, frames_.find(x, scope, child_text(x, "child")));
    type(x, j);
    j.origin = frames_.relative(x, j.parent, frame), j.child_pose = frames_.relative(x, frame, j.child);
    engine(x);
    const placement at{scope, frame};
    if (has_one_coordinate(j)) axis(axis_of(x, "axis"), at, j);
    if (j.is == kind::screw) j.pitch = pitch(x);
    rotor(x, j);
    const auto t = x.text("type");
    if (t == "universal" || t == "revolute2") return two_axes(x, at, std::move(j));
    d_.joints.push_back(std::move(j));
  }

  /// Couples the joints of gearboxes: the angle of the child, from the reference body, is -gearbox_ratio times that of
  /// the parent.
  void couple_gearboxes() {
    for (std::size_t i = 0; i < d_.joints.size() && !gearboxes_.empty(); ++i)
      if (const auto& j = d_.joints[i]; j.is == kind::revolute) turning_.emplace(std::minmax(j.parent, j.child), i);
    for (const auto& g : gearboxes_) {
      const auto reference =
          frames_.link_of(g.x, frames_.find(g.x, g.scope, child_text(g.x, "gearbox_reference_body")));
      const auto [leader, leads] = angle_of(g, reference, "parent", "axis");
      const auto [follower, follows] = angle_of(g, reference, "child", "axis2");
      if (leader == follower) g.x.fail("its parent and child are moved by the same joint");
      if (follower->mimic) g.x.fail("joint '" + excerpt(follower->name) + "' follows another one already");
      follower->mimic = {leader->name, -child_number(g.x, "gearbox_ratio", 1) * leads * follows, 0};
    }
  }

 private:
  using kind = robot_joint::kind;
  struct gearbox {
    xml_item x;
    sdf_scope scope;
    std::string frame;
  };
  struct placement {
    const sdf_scope& scope;
    const std::string& frame;  ///< of the joint
  };

  static void type(const xml_item& x, robot_joint& j) {
    static const std::map<std::string, kind, std::less<>> types{
        {"revolute", kind::revolute},  {"continuous", kind::revolute}, {"prismatic", kind::prismatic},
        {"fixed", kind::fixed},        {"ball", kind::spherical},      {"screw", kind::screw},
        {"universal", kind::revolute}, {"revolute2", kind::revolute}};
    const auto t = x.text("type");
    const auto known = types.find(t);
    if (known == types.end())
      x.fail("type '" + excerpt(t) +
             "' is none of revolute, continuous, prismatic, fixed, ball, screw, universal, revolute2, gearbox");
    j.is = known->second, j.continuous = t == "continuous";
  }
  static xml_item axis_of(const xml_item& x, const char* of) {
    const auto a = first_child(x, of);
    if (!a) x.fail(std::string("has no <") + of + ">");
    return *a;
  }
  /// Adds a joint with two axes: two joints, with a massless link between them.
  void two_axes(const xml_item& x, const placement& at, robot_joint j) {
    auto second = j;
    if (names_.empty())
      for (const auto& l : d_.links) names_.take(l.name);
    auto& middle = d_.links.emplace_back();
    middle.name = names_.fresh(j.child + ".cross"), middle.line = j.line, middle.file = j.file;
    j.child = second.parent = middle.name, second.origin = {}, j.child_pose = {};
    second.name = j.name + "_2", second.mimic.reset();
    axis(axis_of(x, "axis2"), at, second);
    d_.joints.push_back(std::move(j)), d_.joints.push_back(std::move(second));
  }

  void axis(const xml_item& x, const placement& at, robot_joint& j) const {
    x.only({"xyz", "limit", "dynamics", "mimic"}, {});
    direction(x, at, j);
    j.lower = -robot_joint::none, j.upper = j.rate = j.effort = robot_joint::none;
    if (const auto l = first_child(x, "limit")) {
      l->only({"lower", "upper", "effort", "velocity"}, {});
      const auto bound = [](double b) { return std::abs(b) >= 1e16 ? std::copysign(robot_joint::none, b) : b; };
      const auto most = [](double b) { return b < 0 ? robot_joint::none : b; };  // -1: no limit
      if (!j.continuous)
        j.lower = bound(child_limit(*l, "lower", -1e16)), j.upper = bound(child_limit(*l, "upper", 1e16));
      j.effort = most(child_limit(*l, "effort", -1)), j.rate = most(child_limit(*l, "velocity", -1));
      check_range(*l, j.lower, j.upper, "lower", "upper");
    }
    j.soft_lower = j.lower, j.soft_upper = j.upper;
    j.dynamics = {};
    if (const auto y = first_child(x, "dynamics")) {
      y->only({"damping", "friction", "spring_reference", "spring_stiffness"}, {});
      j.dynamics = {child_number(*y, "damping", 0), child_number(*y, "friction", 0),
                    child_number(*y, "spring_stiffness", 0), child_number(*y, "spring_reference", 0), 0};
      if (j.dynamics.damping < 0 || j.dynamics.friction < 0 || j.dynamics.stiffness < 0)
        y->fail("damping, friction and stiffness must not be negative");
    }
    if (const auto m = first_child(x, "mimic")) mimic(*m, at.scope, j);
  }
  void direction(const xml_item& x, const placement& at, robot_joint& j) const {
    const auto n = first_child(x, "xyz");
    if (!n || (trimmed_content(*n).empty())) x.warn("has no <xyz>: it is 0 0 1, the default of SDF");
    j.axis = {0, 0, 1};
    if (!n) return;
    if (!trimmed_content(*n).empty()) j.axis = unit_axis(*n, n->three(n->list_of(n->content(), "xyz"), "xyz"));
    if (const auto in = n->text_or("expressed_in", ""); !in.empty())
      j.axis = frames_.relative(x, at.frame, frames_.find(*n, at.scope, in)).rotation * j.axis;
  }
  /// Reads q = multiplier (q_leader - reference) + offset.
  static void mimic(const xml_item& x, const sdf_scope& scope, robot_joint& j) {
    x.only({"multiplier", "offset", "reference"}, {"joint", "axis"});
    const auto which = x.text_or("axis", "axis");
    if (which != "axis" && which != "axis2") x.fail("axis '" + excerpt(which) + "' is neither axis nor axis2");
    const double ratio = child_number(x, "multiplier", 1);
    j.mimic = {scope.full(x.text("joint")) + (which == "axis2" ? "_2" : ""), ratio,
               child_number(x, "offset", 0) - ratio * child_number(x, "reference", 0)};
  }
  /// The pitch, m/rad. <screw_thread_pitch> is in metres per turn; the older <thread_pitch> is in rad/m, with the
  /// opposite sign.
  static double pitch(const xml_item& x) {
    if (filled_child(x, "screw_thread_pitch")) return child_number(x, "screw_thread_pitch", 1) / (2 * std::numbers::pi);
    if (!filled_child(x, "thread_pitch")) {
      x.warn("has no <screw_thread_pitch>: it is 1 m per turn, the default of SDF");
      return 1 / (2 * std::numbers::pi);
    }
    const double turns = child_number(x, "thread_pitch", 1);
    if (turns == 0) x.fail("thread_pitch must not be 0");
    return -1 / turns;
  }
  /// Reads the rotor inertia of Drake, as it acts on the joint.
  static void rotor(const xml_item& x, robot_joint& j) {
    const double ratio = child_number(x, "drake:gear_ratio", 1), inertia = child_number(x, "drake:rotor_inertia", 0);
    if (inertia < 0) x.fail("drake:rotor_inertia must not be negative, got " + number(inertia));
    if (inertia > 0) j.dynamics.armature = inertia * ratio * ratio;
    for (const char* of : {"drake:mimic", "drake:controller_gains"})
      for (const auto& c : x.children(of)) c.moves_differently("not read");
  }
  /// Notes the parameters of a simulator, for its solver, motors and suspensions.
  static void engine(const xml_item& x) {
    for (const auto& p : x.children("physics")) {
      p.not_read("not read");
      const auto ode = first_child(p, "ode");
      if (!ode) continue;
      if (child_number(*ode, "max_force", 0) != 0 && child_number(*ode, "velocity", 0) != 0)
        ode->moves_differently("its motor is not read");
      if (const auto s = first_child(*ode, "suspension"); s && child_number(*s, "cfm", 0) != 0)
        s->moves_differently("not read");
    }
  }

  /// The angle of the joint between the reference body of a gearbox and another link, about an axis of the gearbox: the
  /// joint, and +1 or -1 by the direction of that axis.
  std::pair<robot_joint*, double> angle_of(const gearbox& g, const std::string& reference, const char* end,
                                           const char* axis) const {
    const auto link = frames_.link_of(g.x, frames_.find(g.x, g.scope, child_text(g.x, end)));
    robot_joint about;
    direction(axis_of(g.x, axis), {g.scope, g.frame}, about);
    const vec3<> n = frames_.relative(g.x, reference, g.frame).rotation * about.axis;
    const auto known = turning_.find(std::minmax(reference, link));
    if (known == turning_.end())
      g.x.fail("there is no revolute joint between its reference body '" + excerpt(reference) + "' and its " + end +
               " '" + excerpt(link) + "'");
    auto& j = d_.joints[known->second];
    const bool onward = j.parent == reference;
    const double cosine =
        dot(n, onward ? j.origin.rotation * j.axis : transpose(j.child_pose.rotation) * j.axis) * (onward ? 1 : -1);
    if (std::abs(std::abs(cosine) - 1) > 1e-6)
      g.x.fail("its " + std::string(axis) + " is not that of joint '" + excerpt(j.name) + "'");
    return {&j, cosine > 0 ? 1 : -1};
  }

  robot_description& d_;
  const sdf_frames& frames_;
  std::vector<gearbox> gearboxes_;
  std::map<std::pair<std::string, std::string>, std::size_t> turning_;  ///< the first revolute joint between two links
  free_names names_;                                                    ///< of links, where a joint needs another one
};

}  // namespace kte::detail
