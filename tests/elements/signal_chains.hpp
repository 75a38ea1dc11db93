#pragma once

#include <kte/dynamics.hpp>
#include <kte/simulation.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

/// Chains with measures and controls.
namespace kte::test::signals {

// clang-format off
inline constexpr struct q_       final : coord_key<"q">           {} q;
inline constexpr struct lift_    final : coord_key<"lift">        {} lift;
inline constexpr struct ground_  final : frame_3D_key<"ground">   {} ground;
inline constexpr struct table_   final : frame_3D_key<"table">    {} table;
inline constexpr struct arm_     final : frame_3D_key<"arm">      {} arm;
inline constexpr struct tool_    final : frame_3D_key<"tool">     {} tool;
inline constexpr struct floor_   final : frame_2D_key<"floor">    {} floor_frame;
inline constexpr struct cam_     final : frame_2D_key<"cam">      {} cam;
inline constexpr struct rod_     final : frame_2D_key<"rod">      {} rod;
inline constexpr struct r_       final : vector_key<"r">          {} r;
inline constexpr struct w_       final : vector_key<"w">          {} w;
inline constexpr struct al_      final : vector_key<"al">         {} al;
inline constexpr struct seen_p_  final : vector_key<"seen.p">     {} seen_p;
inline constexpr struct seen_v_  final : vector_key<"seen.v">     {} seen_v;
inline constexpr struct seen_r_  final : vector_key<"seen.r">     {} seen_r;
inline constexpr struct seen_w_  final : vector_key<"seen.w">     {} seen_w;
inline constexpr struct seen_a_  final : vector_key<"seen.a">     {} seen_a;
inline constexpr struct speed_   final : input_key<"speed">       {} speed;
inline constexpr struct rate_    final : input_key<"rate">        {} rate;
inline constexpr struct wanted_  final : input_key<"wanted">      {} wanted;
inline constexpr struct drive_   final : input_key<"drive">       {} drive;
inline constexpr struct sum_     final : internal_key<"sum">      {} sum;
inline constexpr struct where_   final : internal_key<"where">    {} where;
inline constexpr struct nothing_ final : vector_key<"nothing">    {} nothing;
inline constexpr struct part_e_  final : internal_key<"e">      {} part_e;
inline constexpr struct part_x_  final : internal_key<"x">      {} part_x;
inline constexpr struct part_y_  final : internal_key<"y">      {} part_y;
inline constexpr struct part_z_  final : internal_key<"z">      {} part_z;
// clang-format on

inline constexpr pid_gains gains{.proportional = 80, .integral = 40, .derivative = 6, .limit = 20, .tracking = 0.0125};
inline constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};

inline constexpr auto key_itself = [](const auto& key) { return key; };
inline constexpr auto text_of_key = [](const auto& key) { return std::string(key.name); };
inline constexpr auto to_static = [](const auto&... e) { return chain(e...).gravity(vec3{0.3, -0.4, -9.81}); };
inline constexpr auto to_flat = [](const auto&... e) { return chain(e...).gravity(vec3{0.3, -0.4, zero}); };
inline constexpr auto to_runtime = [](const auto&... e) {
  runtime_chain c;
  (c << ... << e);
  return c.gravity(vec3{0.3, -0.4, -9.81});
};

/// An arm on a table that turns, driven by a controller, and all measures on its tool.
template <class Name, class To>
auto measured_arm(const Name& name, const To& to) {
  return to(rotation_control_3D(name(r), name(w), name(al), name(ground), name(table)),
            pid_control_gen(name(q), name(wanted), name(sum), name(drive), gains),
            revolute_joint_3D(name(q), name(table), name(arm), axis::y), inertia_3D(name(arm), body),
            driving_actuator_gen(name(q), name(drive)), rigid_link_3D(name(arm), name(tool), vec3{0.3, -0.1, 0.2}),
            position_measure_3D(name(tool), name(seen_p)), velocity_measure_3D(name(tool), name(seen_v)),
            rotation_measure_3D(name(tool), name(seen_r)), ang_velocity_measure_3D(name(tool), name(seen_w)),
            acceleration_measure_3D(name(tool), name(seen_a)));
}
/// A coordinate at a given rate lifts a disc, whose angle is measured by what another controller wants.
template <class Name, class To>
auto followed_disc(const Name& name, const To& to) {
  return to(ang_velocity_control_2D(name(speed), name(rate), name(where), name(floor_frame), name(cam)),
            revolute_joint_2D(name(q), name(cam), name(rod)),
            inertia_2D(name(rod), planar_body(2.0, 0.3, along_x(0.1))), rotation_measure_2D(name(rod), name(wanted)),
            pid_control_gen(name(q), name(wanted), name(sum), name(drive), gains),
            driving_actuator_gen(name(q), name(drive)));
}
template <class A, class B>
double difference_of(const A& a, const B& b) {
  return (a - b).template lpNorm<Eigen::Infinity>() / std::max(1.0, b.template lpNorm<Eigen::Infinity>());
}
template <class V>
vec3<digits50> derivative_of(V position) {  // by differences: h^2 = 1e-34
  const digits50 h("1e-17");
  return (1 / (2 * h)) * (position(h) - position(digits50(-h)));
}

}  // namespace kte::test::signals
