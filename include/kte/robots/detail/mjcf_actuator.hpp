#pragma once

#include <kte/robots/detail/mjcf_joint.hpp>
#include <kte/robots/detail/no_limit.hpp>

namespace kte::detail {

/// Reads the law of an actuator of MJCF,
///
///   f = a u + b0 + b1 x + b2 x_dot          (1)
///
/// and notes the part of it that is not modelled.
inline void read_mjcf_law(const xml_item& x, robot_actuator& a) {
  auto& law = a.law;
  const auto kind = x.name();
  const auto numbers = [&](const char* of, double first) {
    auto all = x.has(of) ? x.completed_list(of, 3) : std::vector<double>{first};
    all.resize((std::max)(all.size(), std::size_t{3}));
    return all;
  };
  const auto gain = numbers("gainprm", 1);
  if (kind == "position") {
    law.gain = law.stiffness = x.not_negative_or("kp", gain[0]), law.damping = x.not_negative_or("kv", 0);
    for (const auto* odd : {"dampratio", "timeconst"})
      if (x.number_or(odd, 0) != 0) a.not_modelled = odd;
  } else if (kind == "velocity") {
    law.gain = law.damping = x.not_negative_or("kv", gain[0]);
  } else if (kind == "general") {
    const auto type_of = [&](const char* key, const char* usual) { return x.text_or(key, usual); };
    const auto gains = type_of("gaintype", "fixed"), biases = type_of("biastype", "none");
    const auto bias = numbers("biasprm", 0);
    law.gain = gain[0];
    if (biases == "affine") law.offset = bias[0], law.stiffness = 0.0 - bias[1], law.damping = 0.0 - bias[2];
    if (gains != "fixed" && (gains != "affine" || gain[1] != 0 || gain[2] != 0)) a.not_modelled = "gaintype " + gains;
    if (biases != "affine" && biases != "none") a.not_modelled = "biastype " + biases;
    if (const auto states = type_of("dyntype", "none"); states != "none") a.not_modelled = "dyntype " + states;
    if (!x.has("gainprm") && (x.has("kp") || x.has("kv"))) a.not_modelled = "its class, of actuators of another kind,";
  } else if (kind != "motor") {
    a.not_modelled = kind;
  }
}

/// Reads an actuator of MJCF. The result has no `joint` if it acts on something else.
inline robot_actuator read_mjcf_actuator(const xml_item& x, const mjcf_scope& in) {
  robot_actuator a{x.has("name") ? in.named(x.text("name")) : "", x.line(), {}};
  for (const auto* of : {"jointinparent", "joint"})  // equivalent for joints of one coordinate
    if (x.has(of)) a.joint = in.named(x.text(of));
  if (x.has("gear"))
    if (const auto gear = x.list("gear"); !gear.empty()) a.gear = gear[0];
  read_mjcf_law(x, a);
  if (a.joint.empty() || !a.not_modelled.empty()) return a;
  const auto range = [&](const char* of, const char* limited, double& lower, double& upper) {
    if (const auto r = mjcf_range(x, of, limited, in.model->settings))
      lower = limit_from_file(r->first), upper = limit_from_file(r->second);
  };
  range("ctrlrange", "ctrllimited", a.law.lower_command, a.law.upper_command);
  range("forcerange", "forcelimited", a.law.lower, a.law.upper);
  x.only({}, {"name", "class", "joint", "jointinparent", "gear", "group", "user", "gainprm", "gaintype", "biastype",
              "biasprm", "dyntype", "dynprm", "kp", "kv", "ctrlrange", "ctrllimited", "forcerange", "forcelimited"});
  return a;
}

}  // namespace kte::detail
