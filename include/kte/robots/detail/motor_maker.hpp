#pragma once

#include <kte/elements/compiled_elements.hpp>
#include <kte/robots/detail/free_names.hpp>
#include <kte/robots/robot.hpp>

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace kte::detail {

/// A range scaled by a factor, which may be negative.
inline std::pair<double, double> scaled_range(double factor, double lower, double upper) {
  return factor < 0 ? std::pair{factor * upper, factor * lower} : std::pair{factor * lower, factor * upper};
}

/// Adds the motors of a robot to its chain.
class motor_maker {
 public:
  motor_maker(robot& r, const motor_options& o) : r_(r), o_(o), made_(r) {}

  void add() {
    if (!r_.motors.empty()) raise<bad_argument>("kte: the robot '" + r_.name + "' has motors already");
    check_options(), check_limits(r_.chain, r_.limits);
    const auto places = layout(r_.chain);
    for (const auto& e : places) names_.take(e.name);
    for (const auto& j : r_.joints) names_.take(j);
    check_joints(places);
    for (const auto& a : r_.actuators) by_joint_[a.joint].push_back(&a);
    std::string rates, ranges;
    for (const auto& e : places) {
      if (e.what != kind::gen) continue;
      const auto v = static_cast<std::size_t>(e.v);
      motors_of(e);
      if (r_.limits.rate[v] != motor_law::none) list(rates, e.name);
      stop(e.name, r_.limits.lower[v], r_.limits.upper[v], ranges);
    }
    note(rates, "motors do not keep the limits of rates: ");
    note(ranges, "ranges are no stops (motor_options::stop_stiffness): ");
    r_ = std::move(made_);
  }

 private:
  using place = layout_entry<std::string>;

  void check_options() const {
    const auto check = [](double x, const char* what) {
      if (!(x >= 0 && x < motor_law::none))
        raise<bad_argument>("kte: motor_options: " + std::string(what) + " must be finite and not negative, got " +
                            number(x));
    };
    check(o_.stiffness, "stiffness"), check(o_.damping, "damping");
    check(o_.stop_stiffness, "stop_stiffness"), check(o_.stop_damping, "stop_damping");
    if (o_.stiffness == 0 && o_.damping > 0)
      raise<bad_argument>("kte: motor_options: a servo with damping needs a stiffness");
  }
  static std::string title(const robot_actuator& a) {
    return a.name.empty() ? "the actuator of joint '" + a.joint + "'" : "actuator '" + a.name + "'";
  }
  void warn(const robot_actuator& a, const std::string& why) {
    made_.warnings.push_back({a.line, title(a) + " is left out: " + why});
  }
  /// Warns about actuators on joints that a motor cannot drive.
  void check_joints(const std::vector<place>& places) {
    std::unordered_map<std::string_view, kind> kinds_of;
    for (const auto& e : places) kinds_of.emplace(e.name, e.what);
    const std::unordered_set<std::string_view> joints(r_.joints.begin(), r_.joints.end());
    for (const auto& a : r_.actuators)
      if (const auto at = kinds_of.find(a.joint); at == kinds_of.end())
        warn(a, joints.contains(a.joint) ? "joint '" + a.joint + "' follows another"
                                         : "there is no joint '" + a.joint + "' that moves");
      else if (at->second != kind::gen)
        warn(a, "joint '" + a.joint + "' has several degrees of freedom");
  }

  void motors_of(const place& e) {
    const double effort = r_.limits.effort[static_cast<std::size_t>(e.v)];
    if (r_.actuators.empty()) {
      if (effort > 0) return add(e, "", {}, effort);
      made_.not_read.push_back({0, "joint '" + e.name + "' has no motor: the limit of its effort is 0"});
    }
    std::size_t count = 0;
    for (const auto* of_joint : by_joint_[e.name]) {
      const auto& a = *of_joint;
      if (!a.not_modelled.empty()) {
        warn(a, a.not_modelled + " is not modelled");
      } else if (a.gear == 0) {
        warn(a, "its gear is 0");
      } else {
        add(e, a.name, at_joint(a), effort);
        if (++count == 2 && effort < motor_law::none)
          made_.warnings.push_back(
              {a.line, "joint '" + e.name + "' has several motors: each has the limit of its effort"});
      }
    }
  }
  /// The law of an actuator in terms of the joint: x = gear q, f = gear f_x.
  static motor_law at_joint(const robot_actuator& a) {
    auto law = a.law;
    law.gain *= a.gear, law.offset *= a.gear;
    law.stiffness *= a.gear * a.gear, law.damping *= a.gear * a.gear;
    std::tie(law.lower, law.upper) = scaled_range(a.gear, law.lower, law.upper);
    return law;
  }
  void add(const place& e, const std::string& name, motor_law law, double effort) {
    if (o_.stiffness > 0 && law.offset == 0 && law.stiffness == 0 && law.damping == 0 && law.gain != 0) {
      const auto [least, most] = scaled_range(law.gain, law.lower_command, law.upper_command);
      law = {o_.stiffness,
             0,
             o_.stiffness,
             o_.damping,
             std::clamp(least, law.lower, law.upper),
             std::clamp(most, law.lower, law.upper)};
    }
    law.lower = std::clamp(law.lower, -effort, effort), law.upper = std::clamp(law.upper, -effort, effort);
    auto input = name.empty() || !names_.take(name) ? names_.fresh(e.name + ".motor") : name;
    made_.chain << joint_motor_gen(e.name, input, law);
    made_.motors.push_back({std::move(input), e.name, e.v});
  }
  void stop(const std::string& joint, double lower, double upper, std::string& ranges) {
    if (lower == -motor_law::none && upper == motor_law::none) return;
    if (o_.stop_stiffness == 0) return list(ranges, joint);
    made_.chain << joint_limit_gen(joint, {lower, upper, o_.stop_stiffness, o_.stop_damping});
  }
  static void list(std::string& all, const std::string& joint) {
    all.append(all.empty() ? "joint '" : ", '").append(joint).append("'");
  }
  void note(const std::string& joints, const char* what) {
    if (!joints.empty()) made_.not_read.push_back({0, what + joints});
  }

  robot& r_;
  const motor_options& o_;
  robot made_;
  free_names names_;
  std::unordered_map<std::string_view, std::vector<const robot_actuator*>> by_joint_;
};

}  // namespace kte::detail
