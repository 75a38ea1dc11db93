#pragma once

#include <kte/errors.hpp>
#include <kte/math/vec.hpp>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace evaluate {

inline constexpr const char* usage =
    "usage: evaluate robot.urdf|model.json|model.xml|model.kte states.csv [options]\n"
    "       evaluate --check robot.urdf\n"
    "  --gravity x y z    m/s^2; (0, 0, -9.81) of a URDF, that of a model file\n"
    "  --frame name       also its pose and its Jacobian in axes of the world; may come several times\n"
    "  --derivatives      also those of inverse and forward dynamics by q and v\n"
    "  --floating-base    the root moves freely: its q and v come first\n"
    "  --joint-dynamics   with damping, friction, springs and rotors of joints\n"
    "  --precision 50     with 50 digits instead of 17\n"
    "  --static           by a program for this robot, which is compiled once\n"
    "  --help             this\n";

struct options {
  std::filesystem::path robot, states;
  std::optional<kte::vec3<>> gravity;
  std::vector<std::string> frames;
  bool derivatives = false, floating_base = false, joint_dynamics = false, by_type = false, check = false, help = false;
  int digits = 17;
};

/// What the command line says; throws `kte::bad_argument`.
inline options read_options(int count, char** arguments) {
  options o;
  int i = 1;
  const auto next = [&](const std::string& of) -> std::string {
    if (i == count) throw kte::bad_argument("kte: " + of + " needs more behind it");
    return arguments[i++];
  };
  const auto number = [&](const std::string& of) {
    const std::string text = next(of);
    double x{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (code != std::errc{} || end != text.data() + text.size())
      throw kte::bad_argument("kte: " + of + ": '" + text + "' is not a number");
    if (!std::isfinite(x)) throw kte::bad_argument("kte: " + of + ": '" + text + "' is not finite");
    return x;
  };
  while (i < count) {
    const std::string x = arguments[i++];
    if (x == "--gravity") {
      const double gx = number(x), gy = number(x), gz = number(x);
      o.gravity = {gx, gy, gz};
    } else if (x == "--frame") {
      o.frames.push_back(next(x));
    } else if (x == "--precision") {
      const std::string digits = next(x);
      if (digits != "17" && digits != "50")
        throw kte::bad_argument("kte: --precision is 17 or 50, not '" + digits + "'");
      o.digits = digits == "50" ? 50 : 17;
    } else if (x == "--derivatives") {
      o.derivatives = true;
    } else if (x == "--floating-base") {
      o.floating_base = true;
    } else if (x == "--joint-dynamics") {
      o.joint_dynamics = true;
    } else if (x == "--static") {
      o.by_type = true;
    } else if (x == "--check") {
      o.check = true;
    } else if (x == "--help") {
      o.help = true;
      return o;
    } else if (x.starts_with("-") && x.size() > 1) {
      throw kte::bad_argument("kte: there is no option '" + x + "'");
    } else if (o.robot.empty()) {
      o.robot = x;
    } else if (o.states.empty()) {
      o.states = x;
    } else {
      throw kte::bad_argument("kte: '" + x + "' is one file too many");
    }
  }
  if (o.robot.empty()) throw kte::bad_argument("kte: no robot is given");
  if (o.states.empty() && !o.check) throw kte::bad_argument("kte: no file of states is given");
  if (!o.states.empty() && o.check) throw kte::bad_argument("kte: --check takes a robot and no states");
  return o;
}

}  // namespace evaluate
