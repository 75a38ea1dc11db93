#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/elements/acceleration_measure.hpp>
#include <kte/elements/ang_velocity_control.hpp>
#include <kte/elements/ang_velocity_measure.hpp>
#include <kte/elements/base.hpp>
#include <kte/elements/bushing.hpp>
#include <kte/elements/closures.hpp>
#include <kte/elements/constant_force.hpp>
#include <kte/elements/damper.hpp>
#include <kte/elements/dc_motor.hpp>
#include <kte/elements/differential.hpp>
#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/dry_revolute_joint.hpp>
#include <kte/elements/dyad.hpp>
#include <kte/elements/external_force.hpp>
#include <kte/elements/flexible_beam.hpp>
#include <kte/elements/fluid_drag.hpp>
#include <kte/elements/force_actuator.hpp>
#include <kte/elements/four_bar.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/inertial_beam.hpp>
#include <kte/elements/joint_backlash.hpp>
#include <kte/elements/joint_backlash_mode.hpp>
#include <kte/elements/joint_damping.hpp>
#include <kte/elements/joint_elasto_plastic.hpp>
#include <kte/elements/joint_friction.hpp>
#include <kte/elements/joint_limit.hpp>
#include <kte/elements/joint_lugre.hpp>
#include <kte/elements/joint_motor.hpp>
#include <kte/elements/joint_stiction.hpp>
#include <kte/elements/joint_stiffness.hpp>
#include <kte/elements/line_point_mindist.hpp>
#include <kte/elements/mimic.hpp>
#include <kte/elements/pid_control.hpp>
#include <kte/elements/planar_joint.hpp>
#include <kte/elements/plane_point_mindist.hpp>
#include <kte/elements/position_control.hpp>
#include <kte/elements/position_measure.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/rotation_control.hpp>
#include <kte/elements/rotation_measure.hpp>
#include <kte/elements/rotor.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/slider_crank.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/elements/sticking_joint.hpp>
#include <kte/elements/table_spring.hpp>
#include <kte/elements/torque_speed_motor.hpp>
#include <kte/elements/torsion_damper.hpp>
#include <kte/elements/torsion_spring.hpp>
#include <kte/elements/velocity_control.hpp>
#include <kte/elements/velocity_measure.hpp>
#include <kte/elements/virtual_kte_interface.hpp>
#include <kte/elements/vmc_revolute_joint.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>

/// The list of the elements of this library: those that files have, and as runtime chains have them, of plain numbers
/// and of unit axes, which kte::compiled has compiled. A new element is a line or two here.
namespace kte {

#ifdef KTE_EXTERN

namespace core {
/// A joint in the plane with a placement of plain numbers.
template <class Joint>
using placed_2D = placed_joint<Joint, rotation_2D<>, vec3<double, double, zero_t>>;
/// A joint in space with a placement of plain numbers.
template <class Joint>
using placed_3D = placed_joint<Joint, mat3<vec3<>>, vec3<>>;
}  // namespace core

#  define KTE_ELEMENT(...) KTE_EXTERN_ELEMENTS template class kte_map_adapter<core::__VA_ARGS__>
KTE_ELEMENT(base<kind::gen>);
KTE_ELEMENT(base<kind::frame_2D>);
KTE_ELEMENT(base<kind::frame_3D>);
KTE_ELEMENT(rigid_link_gen<double>);
KTE_ELEMENT(rigid_link<kind::frame_2D, rotation_2D<>, vec3<double, double, zero_t>>);
KTE_ELEMENT(rigid_link<kind::frame_3D, mat3<vec3<>>, vec3<>>);
KTE_ELEMENT(revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>);
KTE_ELEMENT(revolute_joint<kind::frame_3D, vec3<one_t, zero_t, zero_t>>);
KTE_ELEMENT(revolute_joint<kind::frame_3D, vec3<zero_t, one_t, zero_t>>);
KTE_ELEMENT(revolute_joint<kind::frame_3D, vec3<zero_t, zero_t, one_t>>);
KTE_ELEMENT(revolute_joint<kind::frame_3D, vec3<>>);
KTE_ELEMENT(prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>);
KTE_ELEMENT(prismatic_joint<kind::frame_3D, vec3<one_t, zero_t, zero_t>>);
KTE_ELEMENT(prismatic_joint<kind::frame_3D, vec3<zero_t, one_t, zero_t>>);
KTE_ELEMENT(prismatic_joint<kind::frame_3D, vec3<zero_t, zero_t, one_t>>);
KTE_ELEMENT(prismatic_joint<kind::frame_3D, vec3<>>);
KTE_ELEMENT(spherical_joint);
KTE_ELEMENT(free_joint<kind::frame_2D>);
KTE_ELEMENT(free_joint<kind::frame_3D>);
KTE_ELEMENT(planar_joint);
KTE_ELEMENT(screw_joint<vec3<one_t, zero_t, zero_t>, double>);
KTE_ELEMENT(screw_joint<vec3<zero_t, one_t, zero_t>, double>);
KTE_ELEMENT(screw_joint<vec3<zero_t, zero_t, one_t>, double>);
KTE_ELEMENT(screw_joint<vec3<>, double>);
KTE_ELEMENT(placed_2D<core::revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>);
KTE_ELEMENT(placed_2D<core::prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>>);
KTE_ELEMENT(placed_2D<core::free_joint<kind::frame_2D>>);
KTE_ELEMENT(placed_3D<core::revolute_joint<kind::frame_3D, vec3<one_t, zero_t, zero_t>>>);
KTE_ELEMENT(placed_3D<core::revolute_joint<kind::frame_3D, vec3<zero_t, one_t, zero_t>>>);
KTE_ELEMENT(placed_3D<core::revolute_joint<kind::frame_3D, vec3<zero_t, zero_t, one_t>>>);
KTE_ELEMENT(placed_3D<core::revolute_joint<kind::frame_3D, vec3<>>>);
KTE_ELEMENT(placed_3D<core::prismatic_joint<kind::frame_3D, vec3<>>>);
KTE_ELEMENT(placed_3D<core::spherical_joint>);
KTE_ELEMENT(placed_3D<core::free_joint<kind::frame_3D>>);
KTE_ELEMENT(placed_3D<core::planar_joint>);
KTE_ELEMENT(placed_3D<core::screw_joint<vec3<>, double>>);
KTE_ELEMENT(inertia_gen<double>);
KTE_ELEMENT(inertia<kind::frame_2D, double, vec3<double, double, zero_t>,
                    sym3<zero_t, zero_t, zero_t, zero_t, zero_t, double>>);
KTE_ELEMENT(inertia<kind::frame_3D, double, vec3<>, sym3<>>);
KTE_ELEMENT(spring_gen<double, double, double>);
KTE_ELEMENT(spring<kind::frame_2D, double, double, double>);
KTE_ELEMENT(spring<kind::frame_3D, double, double, double>);
KTE_ELEMENT(table_spring<kind::gen, std::vector<double>>);
KTE_ELEMENT(table_spring<kind::frame_2D, std::vector<double>>);
KTE_ELEMENT(table_spring<kind::frame_3D, std::vector<double>>);
KTE_ELEMENT(damper_gen<double>);
KTE_ELEMENT(damper<kind::frame_2D, double>);
KTE_ELEMENT(damper<kind::frame_3D, double>);
KTE_ELEMENT(torsion_spring<kind::frame_2D, double, double, double>);
KTE_ELEMENT(torsion_spring<kind::frame_3D, double, double, no_rotation>);
KTE_ELEMENT(torsion_spring<kind::frame_3D, double, double, mat3<vec3<>>>);
KTE_ELEMENT(torsion_damper<kind::frame_2D, double>);
KTE_ELEMENT(torsion_damper<kind::frame_3D, double>);
KTE_ELEMENT(bushing_3D);
KTE_ELEMENT(coincident_frames<kind::frame_2D>);
KTE_ELEMENT(coincident_frames<kind::frame_3D>);
KTE_ELEMENT(coincident_points<kind::frame_2D>);
KTE_ELEMENT(coincident_points<kind::frame_3D>);
KTE_ELEMENT(coupled_by_polynomial);
KTE_ELEMENT(coupled_coordinates);
KTE_ELEMENT(cylindrical_3D);
KTE_ELEMENT(distance<kind::frame_2D>);
KTE_ELEMENT(distance<kind::frame_3D>);
KTE_ELEMENT(hinge_3D);
KTE_ELEMENT(point_on_line<kind::frame_2D>);
KTE_ELEMENT(point_on_line<kind::frame_3D>);
KTE_ELEMENT(point_on_plane_3D);
KTE_ELEMENT(sliding<kind::frame_2D>);
KTE_ELEMENT(sliding<kind::frame_3D>);
KTE_ELEMENT(universal_3D);
KTE_ELEMENT(flexible_beam<kind::frame_2D>);
KTE_ELEMENT(flexible_beam<kind::frame_3D>);
KTE_ELEMENT(driving_actuator_gen);
KTE_ELEMENT(driving_actuator<kind::frame_2D>);
KTE_ELEMENT(driving_actuator<kind::frame_3D>);
KTE_ELEMENT(external_force<kind::frame_2D>);
KTE_ELEMENT(external_force<kind::frame_3D>);
KTE_ELEMENT(force_actuator_gen);
KTE_ELEMENT(force_actuator<kind::frame_2D>);
KTE_ELEMENT(force_actuator<kind::frame_3D>);
KTE_ELEMENT(dc_motor_gen);
KTE_ELEMENT(torque_speed_motor_gen);
KTE_ELEMENT(joint_motor_gen);
KTE_ELEMENT(constant_force<kind::frame_2D, vec3<double, double, zero_t>, vec3<zero_t, zero_t, double>>);
KTE_ELEMENT(constant_force<kind::frame_3D, vec3<>, vec3<>>);
KTE_ELEMENT(follower_force<kind::frame_2D, vec3<double, double, zero_t>, vec3<zero_t, zero_t, double>>);
KTE_ELEMENT(follower_force<kind::frame_3D, vec3<>, vec3<>>);
KTE_ELEMENT(fluid_drag<kind::frame_2D, double, double, vec3<double, double, zero_t>>);
KTE_ELEMENT(fluid_drag<kind::frame_3D, double, double, vec3<>>);
KTE_ELEMENT(joint_lugre_gen);
KTE_ELEMENT(joint_elasto_plastic_gen);
KTE_ELEMENT(joint_friction_gen);
KTE_ELEMENT(joint_damping_gen<double>);
KTE_ELEMENT(joint_stiffness_gen<double, double>);
KTE_ELEMENT(joint_backlash_gen<double>);
KTE_ELEMENT(joint_backlash_mode_gen<double>);
KTE_ELEMENT(joint_limit_gen);
KTE_ELEMENT(joint_stiction_gen);
KTE_ELEMENT(brake_gen);
KTE_ELEMENT(mimic<double, double>);
KTE_ELEMENT(differential<double, double>);
KTE_ELEMENT(inertial_beam<kind::frame_2D, double, sym3<zero_t, zero_t, zero_t, zero_t, zero_t, double>>);
KTE_ELEMENT(inertial_beam<kind::frame_3D, double, sym3<>>);
KTE_ELEMENT(four_bar_coupler);
KTE_ELEMENT(four_bar_rocker);
KTE_ELEMENT(dyad_bar1);
KTE_ELEMENT(dyad_bar2);
KTE_ELEMENT(slider_crank_rod);
KTE_ELEMENT(slider_crank_slider);
KTE_ELEMENT(rotor<vec3<>, double, double>);
KTE_ELEMENT(dry_revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>);
KTE_ELEMENT(placed_2D<core::dry_revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>);
KTE_ELEMENT(dry_revolute_joint<kind::frame_3D, vec3<one_t, zero_t, zero_t>>);
KTE_ELEMENT(dry_revolute_joint<kind::frame_3D, vec3<zero_t, one_t, zero_t>>);
KTE_ELEMENT(dry_revolute_joint<kind::frame_3D, vec3<zero_t, zero_t, one_t>>);
KTE_ELEMENT(dry_revolute_joint<kind::frame_3D, vec3<>>);
KTE_ELEMENT(placed_3D<core::dry_revolute_joint<kind::frame_3D, vec3<>>>);
KTE_ELEMENT(sticking_joint<core::revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>);
KTE_ELEMENT(placed_2D<core::sticking_joint<core::revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>>);
KTE_ELEMENT(sticking_joint<core::revolute_joint<kind::frame_3D, vec3<>>>);
KTE_ELEMENT(placed_3D<core::sticking_joint<core::revolute_joint<kind::frame_3D, vec3<>>>>);
KTE_ELEMENT(sticking_joint<core::prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>>);
KTE_ELEMENT(placed_2D<core::sticking_joint<core::prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>>>);
KTE_ELEMENT(sticking_joint<core::prismatic_joint<kind::frame_3D, vec3<>>>);
KTE_ELEMENT(placed_3D<core::sticking_joint<core::prismatic_joint<kind::frame_3D, vec3<>>>>);
KTE_ELEMENT(vmc_revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>);
KTE_ELEMENT(placed_2D<core::vmc_revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>);
KTE_ELEMENT(vmc_revolute_joint<kind::frame_3D, vec3<>>);
KTE_ELEMENT(placed_3D<core::vmc_revolute_joint<kind::frame_3D, vec3<>>>);
KTE_ELEMENT(virtual_kte_interface<kind::gen>);
KTE_ELEMENT(virtual_kte_interface<kind::frame_2D>);
KTE_ELEMENT(virtual_kte_interface<kind::frame_3D>);
KTE_ELEMENT(line_point_mindist<kind::frame_2D, vec3<double, double, zero_t>, vec3<double, double, zero_t>>);
KTE_ELEMENT(line_point_mindist<kind::frame_3D, vec3<>, vec3<>>);
KTE_ELEMENT(plane_point_mindist<vec3<>, vec3<>>);
KTE_ELEMENT(position_control_gen);
KTE_ELEMENT(position_control<kind::frame_2D>);
KTE_ELEMENT(position_control<kind::frame_3D>);
KTE_ELEMENT(position_measure_gen);
KTE_ELEMENT(position_measure<kind::frame_2D>);
KTE_ELEMENT(position_measure<kind::frame_3D>);
KTE_ELEMENT(velocity_measure_gen);
KTE_ELEMENT(velocity_measure<kind::frame_2D>);
KTE_ELEMENT(velocity_measure<kind::frame_3D>);
KTE_ELEMENT(rotation_measure_2D);
KTE_ELEMENT(rotation_measure_3D);
KTE_ELEMENT(ang_velocity_measure_2D);
KTE_ELEMENT(ang_velocity_measure_3D);
KTE_ELEMENT(acceleration_measure<kind::frame_2D>);
KTE_ELEMENT(acceleration_measure<kind::frame_3D>);
KTE_ELEMENT(pid_control_gen);
KTE_ELEMENT(rotation_control_2D);
KTE_ELEMENT(rotation_control_3D);
KTE_ELEMENT(velocity_control_gen);
KTE_ELEMENT(velocity_control_2D);
KTE_ELEMENT(velocity_control_3D);
KTE_ELEMENT(ang_velocity_control_2D);
KTE_ELEMENT(ang_velocity_control_3D);
#  undef KTE_ELEMENT
#endif

namespace detail {
template <class... Family>
struct families {};
/// What model files know (elements/registry.hpp).
using all_families = families<
    acceleration_measure_family, ang_velocity_control_family, ang_velocity_measure_family, axis_closures_family,
    base_family, bushing_family, coincident_frames_family, coincident_points_family, constant_force_family,
    coupled_coordinates_family, damper_family, dc_motor_family, differential_family, driving_actuator_family,
    dry_revolute_joint_family, dyad_family, external_force_family, flexible_beam_family, fluid_drag_family,
    force_actuator_family, four_bar_family, free_joint_family, inertia_family, inertial_beam_family,
    joint_backlash_family, joint_backlash_mode_family, joint_damping_family, joint_elasto_plastic_family,
    joint_friction_family, joint_limit_family, joint_lugre_family, joint_motor_family, joint_stiction_family,
    joint_stiffness_family, line_point_mindist_family, mimic_family, pid_control_family, planar_joint_family,
    plane_point_mindist_family, point_closures_family, position_control_family, position_measure_family,
    prismatic_joint_family, revolute_joint_family, rigid_link_family, rotation_control_family, rotation_measure_family,
    rotor_family, screw_joint_family, slider_crank_family, spherical_joint_family, spring_family, sticking_joint_family,
    table_spring_family, torque_speed_motor_family, torsion_damper_family, torsion_spring_family,
    velocity_control_family, velocity_measure_family, virtual_kte_interface_family, vmc_revolute_joint_family>;
}  // namespace detail

}  // namespace kte
