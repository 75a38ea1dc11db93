#pragma once

#include <kte/models/joint_limits.hpp>

#include "structure.hpp"
#include "text_format.hpp"

namespace kte_tool {

/// Numbers of a mechanism that may be in other units than m, kg, s and rad, in words:
///
///   size      of the whole above 100 m or below 1 mm
///   mass      of the whole above 100 t or below 1 mg
///   inertia   sqrt(I/m) above ten times the size of the mechanism, or of a heavy body below 1/1000 of it
///   centre    of mass further from its frame than ten times that size
///   range     of a joint that turns above seven half turns, as 180 is
///   gravity   neither 0 nor between 1 and 30 m/s^2
inline std::vector<std::string> odd_numbers(const mechanism& m, const structure& s) {
  std::vector<std::string> found;
  const auto say = [&found](const std::string& what) { found.push_back(what); };
  if (s.size > 100) say("it is " + short_number(s.size) + " m large: are lengths in mm?");
  if (s.size > 0 && s.size < 1e-3) say("it is " + short_number(1000 * s.size) + " mm large: are lengths in m?");
  if (s.mass > 1e5) say("it has a mass of " + short_number(s.mass) + " kg: are masses in g?");
  if (s.mass > 0 && s.mass < 1e-6) say("it has a mass of " + short_number(1e6 * s.mass) + " mg: are masses in kg?");
  for (const auto& b : s.bodies) {
    const auto name = "body of '" + b.frame + "': ";
    if (!(b.mass > 0) || !(s.size > 0)) continue;
    const double radius = std::sqrt(std::max(b.moments[2], 0.0) / b.mass);
    if (radius > 10 * s.size)
      say(name + "its inertia is that of a ring of " + short_number(radius) + " m radius, in a mechanism of " +
          short_number(s.size) + " m: is it in kg m^2, about the centre of mass?");
    if (b.mass > s.mass / 100 && radius > 0 && radius < s.size / 1000)
      say(name + "its inertia is that of a ring of " + short_number(1000 * radius) + " mm radius: is it in kg m^2?");
    const double away = std::sqrt(dot(b.centre, b.centre));
    if (away > 10 * s.size)
      say(name + "its centre of mass is " + short_number(away) + " m away, in a mechanism of " + short_number(s.size) +
          " m");
  }
  for (const auto& c : s.coordinates) {
    if (!c.turns || c.v < 0 || c.nv != 1) continue;
    const auto v = static_cast<std::size_t>(c.v);
    for (const double limit : {m.robot.limits.lower[v], m.robot.limits.upper[v]})
      if (std::isfinite(limit) && std::abs(limit) > 22 && std::abs(limit) < 1e300) {
        say("coordinate '" + c.name + "': its range ends at " + short_number(limit) + " rad: is that in degrees?");
        break;
      }
  }
  const auto& g = m.robot.chain.gravity();
  const double size = std::sqrt(dot(g, g));
  if (size > 0 && (size < 1 || size > 30)) say("gravity is " + short_number(size) + " m/s^2");
  return found;
}

}  // namespace kte_tool
