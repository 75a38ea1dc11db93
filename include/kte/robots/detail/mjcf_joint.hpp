#pragma once

#include <kte/robots/detail/mjcf_tree.hpp>

namespace kte::detail {

/// A range, if it is in force: by its own flag, or with autolimits because it is written.
inline std::optional<std::pair<double, double>> mjcf_range(const xml_item& x, const char* range, const char* limited,
                                                           const mjcf_settings& settings) {
  const auto on = keyword(x, limited, {"auto", "true", "false"});
  if (on != "true" && !(on == "auto" && settings.limits_by_range() && x.has(range))) return {};
  if (!x.has(range)) return x.warn(std::string("it is limited and has no ") + range), std::nullopt;
  const auto r = x.list(range);
  if (r.size() != 2) x.fail(std::string(range) + " must have two numbers, got " + std::to_string(r.size()));
  check_range(x, r[0], r[1], "the lower end", "the upper");
  return std::pair{r[0], r[1]};
}

/// Sets the placement and axis of a hinge or slide, and its coordinate `ref` at the configuration of the file.
inline void place_mjcf_joint(const xml_item& x, const mjcf_scope& in, robot_joint& j, double ref) {
  j.origin.position = in.place.position + in.place.rotation * x.vector_or("pos", {});
  j.child_pose.position = vec3<>{} - j.origin.position;
  if (j.is == robot_joint::kind::spherical) return;
  j.axis = unit_direction(x, x.vector_or("axis", {0, 0, 1}));
  if (in.place.rotation != robot_pose{}.rotation) j.axis = unit_direction(x, in.place.rotation * j.axis);
  j.reference = ref;
  if (ref == 0) return;
  if (j.is == robot_joint::kind::revolute) {
    const auto [c, s] = turn_by(-ref, in.model->settings.options().quarter_turn_tolerance);
    const robot_pose back{{}, without_minus_zero(as<double>(rotation_about(j.axis, c, s)))};
    j.child_pose = back * j.child_pose;
  } else {
    j.child_pose.position = j.child_pose.position - ref * j.axis;
  }
}

/// Reads the coefficients of a spring or damper: the linear one, of any sign beside others, and those of higher powers,
/// which current versions of MuJoCo have.
inline void read_coefficients(const xml_item& x, const char* what, double& linear, robot_joint_dynamics::powers& more) {
  if (!x.has(what)) return;
  auto all = x.completed_list(what, 3);
  if (all.empty() || all.size() > 3)
    x.fail(std::string(what) + " must have one to three numbers, got " + std::to_string(all.size()));
  all.resize(3);
  linear = all[0], more = {all[1], all[2]};
  if (linear < 0 && more == robot_joint_dynamics::powers{})
    x.fail(std::string(what) + " must not be negative, got " + number(linear));
}

inline robot_joint_dynamics mjcf_joint_dynamics(const xml_item& x, double rest) {
  robot_joint_dynamics y{0, x.not_negative_or("frictionloss", 0), 0, rest, x.not_negative_or("armature", 0)};
  read_coefficients(x, "damping", y.damping, y.damping_powers);
  read_coefficients(x, "stiffness", y.stiffness, y.stiffness_powers);
  if (!x.has("springdamper")) return y;
  const auto t = x.list("springdamper");
  if (t.size() != 2) x.fail("springdamper must have two numbers, got " + std::to_string(t.size()));
  if (t[0] > 0 && t[1] > 0) y.time_constant = t[0], y.damping_ratio = t[1];
  return y;
}

/// Reads a joint of MJCF, in the axes of its body. A joint without a name is called `usual_name`.
inline robot_joint read_mjcf_joint(const xml_item& x, const mjcf_scope& in, const std::string& usual_name) {
  using kind = robot_joint::kind;
  static const std::map<std::string, kind, std::less<>> types{
      {"free", kind::floating}, {"hinge", kind::revolute}, {"slide", kind::prismatic}, {"ball", kind::spherical}};
  robot_joint j;
  j.line = x.line(), j.file = x.file();
  j.name = x.has("name") ? in.named(x.text("name")) : usual_name;
  if (x.name() == "freejoint") {
    x.only({}, {"name", "class", "align"});
    if (x.text_or("align", "auto") == "true")
      x.warn("align is not read: the coordinates of its body are those of the body's own axes");
    j.is = kind::floating;
    return j;
  }
  x.only({}, {"name", "class", "type", "pos", "axis", "range", "limited", "damping", "stiffness", "armature",
              "frictionloss", "springref", "ref", "springdamper", "actuatorfrcrange", "actuatorfrclimited"});
  const auto type = types.find(x.text_or("type", "hinge"));
  if (type == types.end()) x.fail("type '" + excerpt(x.text("type")) + "' is none of hinge, slide, ball, free");
  j.is = type->second;
  const auto unit = [&](double a) { return j.is == kind::revolute ? in.model->settings.angle(a) : a; };
  j.dynamics = mjcf_joint_dynamics(x, unit(x.number_or("springref", 0)));
  if (j.dynamics.friction > 0 && (x.has("solreffriction") || x.has("solimpfriction")))
    x.moves_differently("how soft its dry friction is (solreffriction, solimpfriction) is not modelled");
  if (j.is == kind::floating) return j;
  place_mjcf_joint(x, in, j, unit(x.number_or("ref", 0)));
  if (j.is == kind::spherical) {
    if (x.has("range") && mjcf_range(x, "range", "limited", in.model->settings))
      x.moves_differently("the range of a ball is not modelled");
    return j;
  }
  const auto range = mjcf_range(x, "range", "limited", in.model->settings);
  if (range) j.lower = unit(range->first), j.upper = unit(range->second);
  j.continuous = j.is == kind::revolute && !range;
  if (const auto force = mjcf_range(x, "actuatorfrcrange", "actuatorfrclimited", in.model->settings))
    j.effort = (std::max)(std::abs(force->first), std::abs(force->second));
  j.soft_lower = j.lower, j.soft_upper = j.upper;
  return j;
}

}  // namespace kte::detail
