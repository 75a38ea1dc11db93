#pragma once

#include <kte/elements/joint_motor.hpp>
#include <kte/runtime_chain.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "text_format.hpp"

namespace kte_tool {

/// A motor of a joint in a chain.
struct motor_in_chain {
  std::string coordinate;
  kte::motor_law law;
};
/// That which has this input, if there is one.
inline std::optional<motor_in_chain> motor_of_input(const kte::runtime_chain& c, std::string_view input) {
  std::optional<motor_in_chain> found;
  c.for_each_element([&](const kte::kte_element& e) {
    if (e.type() != "joint_motor_gen" || e.names().back() != input) return;
    const auto record = e.record();
    const auto number = [&](std::string_view name) {
      for (const auto& p : record.parameters)
        if (p.name == name) return p.values.at(0);
      return 0.0;
    };
    found = {e.names().front(),
             {number("gain"), number("offset"), number("stiffness"), number("damping"), number("lower"),
              number("upper"), number("lower_command"), number("upper_command")}};
  });
  return found;
}

/// What a command u of a motor means, and between which numbers it is:
///
///   force       a u           [N, N m]                   (1)
///   position    a/k u         of a law with stiffness k  (2)
///   velocity    a/c u         of one with damping alone  (3)
class motor_command {
 public:
  /// The joint of the motor: whether it turns, and its limits.
  struct joint {
    bool turns;
    double lower, upper, rate;
  };

  motor_command(const kte::motor_law& law, const joint& j) : law_(law) {
    const double most = 10;
    if (law.stiffness != 0) {
      const double half = j.turns ? 3.1416 : 1.0;
      set(law.gain / law.stiffness, j.turns ? "rad" : "m", finite_or(j.lower, -half), finite_or(j.upper, half));  // (2)
    } else if (law.damping != 0) {
      const double rate = finite_or(j.rate, most);
      set(law.gain / law.damping, j.turns ? "rad/s" : "m/s", -rate, rate);  // (3)
    } else {
      const double low = finite_or(law.lower, -most), high = finite_or(law.upper, most);
      set(law.gain, j.turns ? "N m" : "N", low, high);  // (1)
    }
  }

  const std::string& unit() const { return unit_; }
  double lower() const { return lower_; }
  double upper() const { return upper_; }
  /// The command that asks a servo to stay at q; else that which is there.
  double at_start(double q, double given) const {
    const double u = law_.stiffness != 0 && law_.gain != 0 ? (law_.stiffness * q - law_.offset) / law_.gain : given;
    return std::clamp(u, lower_, upper_);
  }

 private:
  static double finite_or(double x, double instead) { return std::abs(x) < 1e6 ? x : instead; }
  /// A command of 1 is `scale` of a unit; least and most are in units.
  void set(double scale, const char* unit, double least, double most) {
    if (std::isfinite(most / scale) && std::isfinite(least / scale)) {
      unit_ = scale == 1 ? unit : "\u00D7 " + short_number(scale) + ' ' + unit;
      std::tie(least, most) = std::minmax({least / scale, most / scale});
    }
    lower_ = finite_or(law_.lower_command, least), upper_ = finite_or(law_.upper_command, most);
    if (lower_ < upper_) return;
    const bool below = std::abs(law_.lower_command) < 1e6;
    below ? upper_ = lower_ + 1 : lower_ = upper_ - 1;
  }

  kte::motor_law law_;
  std::string unit_ = "1";
  double lower_ = 0, upper_ = 0;
};

}  // namespace kte_tool
