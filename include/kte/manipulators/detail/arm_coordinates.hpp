#pragma once

#include <kte/dynamics/arguments/diagnose.hpp>
#include <kte/manipulators/manipulator.hpp>

/// Common names for coordinates of static and runtime manipulators, for numerical inverse kinematics.
namespace kte::detail {

/// The sizes of v and q if known at compile time; otherwise -1 (Eigen::Dynamic).
template <class Arm>
inline constexpr int arm_dofs = -1;
template <class Chain, key_type... Tools>
inline constexpr int arm_dofs<manipulator<Chain, tool_keys<Tools...>>> = Chain::dofs;
template <class Arm>
inline constexpr int arm_numbers = -1;
template <class Chain, key_type... Tools>
inline constexpr int arm_numbers<manipulator<Chain, tool_keys<Tools...>>> = Chain::nq;

template <class Arm>
constexpr std::size_t dofs_of(const Arm& arm) {
  if constexpr (arm_dofs<Arm> >= 0) {
    return std::size_t{arm_dofs<Arm>};
  } else {
    return static_cast<std::size_t>(arm.dofs());
  }
}

/// The size of a configuration.
template <class Arm>
constexpr std::size_t numbers_of(const Arm& arm) {
  if constexpr (arm_numbers<Arm> >= 0) {
    return std::size_t{arm_numbers<Arm>};
  } else {
    return static_cast<std::size_t>(arm.nq());
  }
}

/// Calls visit(freedom) for the degrees of freedom, in their order.
template <class Arm, class Visit>
constexpr void for_each_freedom_of(const Arm& arm, const Visit& visit) {
  if constexpr (arm_dofs<Arm> >= 0) {
    for (std::size_t i = 0; i < Arm::wiring::freedoms; ++i) visit(Arm::wiring::table.free[i]);
  } else {
    for (const freedom& f : arm.wiring().free) visit(f);
  }
}

/// Throws `bad_argument`, naming the coordinate, unless q is a configuration of finite numbers.
template <class Arm, class Q>
void check_configuration_of(const Arm& arm, const Q& q, const char* name) {
  const std::size_t n = numbers_of(arm);
  check_size(n, q, name, "numbers of a configuration");
  if (!all_finite(q, n)) [[unlikely]]
    raise_not_finite("a coordinate", layout(arm), {{name, plain_numbers(q, n), true}});
}
/// Rejects invalid rates or accelerations.
template <class Arm, class V>
void check_rates_of(const Arm& arm, const V& v, const char* name, const char* what) {
  check_size(dofs_of(arm), v, name);
  if (!all_finite(v, dofs_of(arm))) [[unlikely]]
    raise_not_finite(what, layout(arm), {{name, plain_numbers(v, dofs_of(arm))}});
}
/// Rejects invalid twists, six numbers for each tool.
template <class Arm, class T>
void check_twists_of(const Arm& arm, const T& twist, const char* name, const char* what) {
  const auto& tools = arm.tools();
  const std::size_t n = 6 * tools.size();
  check_size(n, twist, name, "numbers for its tools");
  if (all_finite(twist, n)) [[likely]]
    return;
  const auto all = plain_numbers(twist, n);
  for (std::size_t i = 0; i < n; ++i)
    if (const double x = all[i]; x - x != 0)
      raise<bad_argument>(std::string("kte: ") + what + " is not finite: " + name + "[" + std::to_string(i) +
                          "] of tool '" + std::string(tools[i / 6]) + "' is " + number(x));
  raise<bad_argument>(std::string("kte: ") + what + " is not finite");
}

[[noreturn, gnu::cold, gnu::noinline]] inline void refuse_limits_of_pose(const std::string& coordinate) {
  throw bad_parameter("kte: limits of " + coordinate +
                      ": only coordinates that are numbers can have limits of position here; limits of rates may be "
                      "given for all");
}
/// Rejects position limits of rotations and poses; only coordinates that are numbers have them.
template <class Arm>
void check_limits_of_poses(const Arm& arm) {
  const auto& limits = arm.limits();
  const auto infinite = [](double x) { return x - x != 0; };
  for_each_freedom_of(arm, [&](const freedom& f) {
    if (f.what == kind::gen) return;
    for (int k = f.v; k < f.v + nv_of(f.what); ++k)
      if (const auto i = static_cast<std::size_t>(k); !infinite(limits.lower[i]) || !infinite(limits.upper[i]))
        refuse_limits_of_pose(text_of_rate(layout(arm), k));
  });
}

}  // namespace kte::detail
