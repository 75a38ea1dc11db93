// No `#pragma once`: this list is read once for the headers, then once for each use of KTE_ELEMENT.

/// The list of the elements of this library: the header of each, and its core types in runtime chains and files, with
/// parameters of plain numbers, and axes x, y, z typed. If several types share a name, a record becomes the first that
/// it fits. Registry, precompiled elements, `kte/static.hpp` and docs/elements.md follow this list. Who takes it in two
/// halves defines KTE_ELEMENT_OF_SECOND_HALF too.
#ifndef KTE_ELEMENT
#  define KTE_ELEMENT(...)
#endif

// clang-format off
#include <kte/elements/acceleration_measure.hpp>
KTE_ELEMENT(acceleration_measure<kind::frame_2D>)
KTE_ELEMENT(acceleration_measure<kind::frame_3D>)
#include <kte/elements/ang_velocity_control.hpp>
KTE_ELEMENT(ang_velocity_control_2D)
KTE_ELEMENT(ang_velocity_control_3D)
#include <kte/elements/ang_velocity_measure.hpp>
KTE_ELEMENT(ang_velocity_measure_2D)
KTE_ELEMENT(ang_velocity_measure_3D)
#include <kte/elements/base.hpp>
KTE_ELEMENT(base<kind::gen>)
KTE_ELEMENT(base<kind::frame_2D>)
KTE_ELEMENT(base<kind::frame_3D>)
#include <kte/elements/bristle_contact.hpp>
KTE_ELEMENT(bristle_contact<kind::frame_2D, core::contact_geometry<kind::frame_2D>>)
KTE_ELEMENT(bristle_contact<kind::frame_3D, core::contact_geometry<kind::frame_3D>>)
#include <kte/elements/bushing.hpp>
KTE_ELEMENT(bushing_3D)
#include <kte/elements/closures/axis_closures.hpp>
KTE_ELEMENT(cylindrical_3D)
KTE_ELEMENT(hinge_3D)
KTE_ELEMENT(sliding<kind::frame_2D>)
KTE_ELEMENT(sliding<kind::frame_3D>)
KTE_ELEMENT(universal_3D)
#include <kte/elements/closures/coincident_frames.hpp>
KTE_ELEMENT(coincident_frames<kind::frame_2D>)
KTE_ELEMENT(coincident_frames<kind::frame_3D>)
#include <kte/elements/closures/coincident_points.hpp>
KTE_ELEMENT(coincident_points<kind::frame_2D>)
KTE_ELEMENT(coincident_points<kind::frame_3D>)
#include <kte/elements/closures/coupled_coordinates.hpp>
KTE_ELEMENT(coupled_by_polynomial)
KTE_ELEMENT(coupled_coordinates)
#include <kte/elements/closures/point_closures.hpp>
KTE_ELEMENT(distance<kind::frame_2D>)
KTE_ELEMENT(distance<kind::frame_3D>)
KTE_ELEMENT(point_on_line<kind::frame_2D>)
KTE_ELEMENT(point_on_line<kind::frame_3D>)
KTE_ELEMENT(point_on_plane_3D)
#include <kte/elements/compliant_contact.hpp>
KTE_ELEMENT(compliant_contact<kind::frame_2D, core::contact_geometry<kind::frame_2D>>)
KTE_ELEMENT(compliant_contact<kind::frame_3D, core::contact_geometry<kind::frame_3D>>)
KTE_ELEMENT(compliant_contact<kind::frame_3D, core::disc_geometry>)
#include <kte/elements/compliant_shapes.hpp>
#include <kte/elements/constant_force.hpp>
KTE_ELEMENT(constant_force<kind::frame_2D, vec3<double, double, zero_t>, vec3<zero_t, zero_t, double>>)
KTE_ELEMENT(constant_force<kind::frame_3D, vec3<>, vec3<>>)
KTE_ELEMENT(follower_force<kind::frame_2D, vec3<double, double, zero_t>, vec3<zero_t, zero_t, double>>)
KTE_ELEMENT(follower_force<kind::frame_3D, vec3<>, vec3<>>)
#include <kte/elements/cylindrical_joint.hpp>
#include <kte/elements/damper.hpp>
KTE_ELEMENT(damper_gen<double>)
KTE_ELEMENT(damper<kind::frame_2D, double>)
KTE_ELEMENT(damper<kind::frame_3D, double>)
#include <kte/elements/dc_motor.hpp>
KTE_ELEMENT(dc_motor_gen)
#include <kte/elements/differential.hpp>
KTE_ELEMENT(differential<double, double>)
#include <kte/elements/driving_actuator.hpp>
KTE_ELEMENT(driving_actuator_gen)
KTE_ELEMENT(driving_actuator<kind::frame_2D>)
KTE_ELEMENT(driving_actuator<kind::frame_3D>)
#include <kte/elements/dry_revolute_joint.hpp>
KTE_ELEMENT(dry_revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>)
KTE_ELEMENT(placed_2D<core::dry_revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>)
KTE_ELEMENT(dry_revolute_joint<kind::frame_3D, vec3<one_t, zero_t, zero_t>>)
KTE_ELEMENT(dry_revolute_joint<kind::frame_3D, vec3<zero_t, one_t, zero_t>>)
KTE_ELEMENT(dry_revolute_joint<kind::frame_3D, vec3<zero_t, zero_t, one_t>>)
KTE_ELEMENT(dry_revolute_joint<kind::frame_3D, vec3<>>)
KTE_ELEMENT(placed_3D<core::dry_revolute_joint<kind::frame_3D, vec3<>>>)
#include <kte/elements/dyad.hpp>
KTE_ELEMENT(dyad_bar1)
KTE_ELEMENT(dyad_bar2)
#include <kte/elements/external_force.hpp>
KTE_ELEMENT(external_force<kind::frame_2D>)
KTE_ELEMENT(external_force<kind::frame_3D>)
#include <kte/elements/fixed_joint.hpp>
#include <kte/elements/flexible_beam.hpp>
KTE_ELEMENT(flexible_beam<kind::frame_2D>)
KTE_ELEMENT(flexible_beam<kind::frame_3D>)
#include <kte/elements/fluid_drag.hpp>
KTE_ELEMENT(fluid_drag<kind::frame_2D, double, double, vec3<double, double, zero_t>>)
KTE_ELEMENT(fluid_drag<kind::frame_3D, double, double, vec3<>>)
#include <kte/elements/force_actuator.hpp>
KTE_ELEMENT(force_actuator_gen)
KTE_ELEMENT(force_actuator<kind::frame_2D>)
KTE_ELEMENT(force_actuator<kind::frame_3D>)
#include <kte/elements/force_law.hpp>
#include <kte/elements/four_bar.hpp>
KTE_ELEMENT(four_bar_coupler)
KTE_ELEMENT(four_bar_rocker)
#include <kte/elements/free_joint.hpp>
KTE_ELEMENT(free_joint<kind::frame_2D>)
KTE_ELEMENT(free_joint<kind::frame_3D>)
KTE_ELEMENT(placed_2D<core::free_joint<kind::frame_2D>>)
KTE_ELEMENT(placed_3D<core::free_joint<kind::frame_3D>>)
#include <kte/elements/inertia.hpp>
KTE_ELEMENT(inertia_gen<double>)
KTE_ELEMENT(inertia<kind::frame_2D, double, vec3<double, double, zero_t>, sym3<zero_t, zero_t, zero_t, zero_t, zero_t, double>>)
KTE_ELEMENT(inertia<kind::frame_3D, double, vec3<>, sym3<>>)
#include <kte/elements/inertial_beam.hpp>
KTE_ELEMENT(inertial_beam<kind::frame_2D, double, sym3<zero_t, zero_t, zero_t, zero_t, zero_t, double>>)
KTE_ELEMENT(inertial_beam<kind::frame_3D, double, sym3<>>)
#include <kte/elements/joint_backlash.hpp>
KTE_ELEMENT(joint_backlash_gen<double>)
#include <kte/elements/joint_backlash_mode.hpp>
KTE_ELEMENT(joint_backlash_mode_gen<double>)
#include <kte/elements/joint_damping.hpp>
KTE_ELEMENT(joint_damping_gen<double>)
#include <kte/elements/joint_elasto_plastic.hpp>
KTE_ELEMENT(joint_elasto_plastic_gen)
#include <kte/elements/joint_friction.hpp>
KTE_ELEMENT(joint_friction_gen)
#include <kte/elements/joint_limit.hpp>
KTE_ELEMENT(joint_limit_gen)
#include <kte/elements/joint_lugre.hpp>
KTE_ELEMENT(joint_lugre_gen)
#include <kte/elements/joint_motor.hpp>
KTE_ELEMENT(joint_motor_gen)
#include <kte/elements/joint_stiction.hpp>
KTE_ELEMENT(joint_stiction_gen)
KTE_ELEMENT(brake_gen)
#ifdef KTE_ELEMENT_OF_SECOND_HALF
#  undef KTE_ELEMENT
#  define KTE_ELEMENT KTE_ELEMENT_OF_SECOND_HALF
#endif
#include <kte/elements/joint_stiffness.hpp>
KTE_ELEMENT(joint_stiffness_gen<double, double>)
#include <kte/elements/law_spring.hpp>
#include <kte/elements/line_point_mindist.hpp>
KTE_ELEMENT(line_point_mindist<kind::frame_2D, vec3<double, double, zero_t>, vec3<double, double, zero_t>>)
KTE_ELEMENT(line_point_mindist<kind::frame_3D, vec3<>, vec3<>>)
#include <kte/elements/mimic.hpp>
KTE_ELEMENT(mimic<double, double>)
#include <kte/elements/pid_control.hpp>
KTE_ELEMENT(pid_control_gen)
#include <kte/elements/planar_joint.hpp>
KTE_ELEMENT(planar_joint)
KTE_ELEMENT(placed_3D<core::planar_joint>)
#include <kte/elements/plane_point_mindist.hpp>
KTE_ELEMENT(plane_point_mindist<vec3<>, vec3<>>)
#include <kte/elements/position_control.hpp>
KTE_ELEMENT(position_control_gen)
KTE_ELEMENT(position_control<kind::frame_2D>)
KTE_ELEMENT(position_control<kind::frame_3D>)
#include <kte/elements/position_measure.hpp>
KTE_ELEMENT(position_measure_gen)
KTE_ELEMENT(position_measure<kind::frame_2D>)
KTE_ELEMENT(position_measure<kind::frame_3D>)
#include <kte/elements/prismatic_joint.hpp>
KTE_ELEMENT(prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>)
KTE_ELEMENT(prismatic_joint<kind::frame_3D, vec3<one_t, zero_t, zero_t>>)
KTE_ELEMENT(prismatic_joint<kind::frame_3D, vec3<zero_t, one_t, zero_t>>)
KTE_ELEMENT(prismatic_joint<kind::frame_3D, vec3<zero_t, zero_t, one_t>>)
KTE_ELEMENT(prismatic_joint<kind::frame_3D, vec3<>>)
KTE_ELEMENT(placed_2D<core::prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>>)
KTE_ELEMENT(placed_3D<core::prismatic_joint<kind::frame_3D, vec3<>>>)
#include <kte/elements/revolute_joint.hpp>
KTE_ELEMENT(revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>)
KTE_ELEMENT(revolute_joint<kind::frame_3D, vec3<one_t, zero_t, zero_t>>)
KTE_ELEMENT(revolute_joint<kind::frame_3D, vec3<zero_t, one_t, zero_t>>)
KTE_ELEMENT(revolute_joint<kind::frame_3D, vec3<zero_t, zero_t, one_t>>)
KTE_ELEMENT(revolute_joint<kind::frame_3D, vec3<>>)
KTE_ELEMENT(placed_2D<core::revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>)
KTE_ELEMENT(placed_3D<core::revolute_joint<kind::frame_3D, vec3<one_t, zero_t, zero_t>>>)
KTE_ELEMENT(placed_3D<core::revolute_joint<kind::frame_3D, vec3<zero_t, one_t, zero_t>>>)
KTE_ELEMENT(placed_3D<core::revolute_joint<kind::frame_3D, vec3<zero_t, zero_t, one_t>>>)
KTE_ELEMENT(placed_3D<core::revolute_joint<kind::frame_3D, vec3<>>>)
#include <kte/elements/rigid_contact.hpp>
KTE_ELEMENT(rigid_contact<kind::frame_2D, core::contact_geometry<kind::frame_2D>>)
KTE_ELEMENT(rigid_contact<kind::frame_3D, core::contact_geometry<kind::frame_3D>>)
KTE_ELEMENT(rigid_contact<kind::frame_3D, core::disc_geometry>)
#include <kte/elements/rigid_link.hpp>
KTE_ELEMENT(rigid_link_gen<double>)
KTE_ELEMENT(rigid_link<kind::frame_2D, rotation_2D<>, vec3<double, double, zero_t>>)
KTE_ELEMENT(rigid_link<kind::frame_3D, mat3<vec3<>>, vec3<>>)
#include <kte/elements/rigid_shapes.hpp>
#include <kte/elements/rotation_control.hpp>
KTE_ELEMENT(rotation_control_2D)
KTE_ELEMENT(rotation_control_3D)
#include <kte/elements/rotation_measure.hpp>
KTE_ELEMENT(rotation_measure_2D)
KTE_ELEMENT(rotation_measure_3D)
#include <kte/elements/rotor.hpp>
KTE_ELEMENT(rotor<vec3<>, double, double>)
#include <kte/elements/screw_joint.hpp>
KTE_ELEMENT(screw_joint<vec3<one_t, zero_t, zero_t>, double>)
KTE_ELEMENT(screw_joint<vec3<zero_t, one_t, zero_t>, double>)
KTE_ELEMENT(screw_joint<vec3<zero_t, zero_t, one_t>, double>)
KTE_ELEMENT(screw_joint<vec3<>, double>)
KTE_ELEMENT(placed_3D<core::screw_joint<vec3<>, double>>)
#include <kte/elements/slider_crank.hpp>
KTE_ELEMENT(slider_crank_rod)
KTE_ELEMENT(slider_crank_slider)
#include <kte/elements/spherical_joint.hpp>
KTE_ELEMENT(spherical_joint)
KTE_ELEMENT(placed_3D<core::spherical_joint>)
#include <kte/elements/spring.hpp>
KTE_ELEMENT(spring_gen<double, double, double>)
KTE_ELEMENT(spring<kind::frame_2D, double, double, double>)
KTE_ELEMENT(spring<kind::frame_3D, double, double, double>)
#include <kte/elements/sticking_joint.hpp>
KTE_ELEMENT(sticking_joint<core::revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>)
KTE_ELEMENT(placed_2D<core::sticking_joint<core::revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>>)
KTE_ELEMENT(sticking_joint<core::revolute_joint<kind::frame_3D, vec3<>>>)
KTE_ELEMENT(placed_3D<core::sticking_joint<core::revolute_joint<kind::frame_3D, vec3<>>>>)
KTE_ELEMENT(sticking_joint<core::prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>>)
KTE_ELEMENT(placed_2D<core::sticking_joint<core::prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>>>)
KTE_ELEMENT(sticking_joint<core::prismatic_joint<kind::frame_3D, vec3<>>>)
KTE_ELEMENT(placed_3D<core::sticking_joint<core::prismatic_joint<kind::frame_3D, vec3<>>>>)
#include <kte/elements/table_spring.hpp>
KTE_ELEMENT(table_spring<kind::gen, std::vector<double>>)
KTE_ELEMENT(table_spring<kind::frame_2D, std::vector<double>>)
KTE_ELEMENT(table_spring<kind::frame_3D, std::vector<double>>)
#include <kte/elements/torque_speed_motor.hpp>
KTE_ELEMENT(torque_speed_motor_gen)
#include <kte/elements/torsion_damper.hpp>
KTE_ELEMENT(torsion_damper<kind::frame_2D, double>)
KTE_ELEMENT(torsion_damper<kind::frame_3D, double>)
#include <kte/elements/torsion_spring.hpp>
KTE_ELEMENT(torsion_spring<kind::frame_2D, double, double, double>)
KTE_ELEMENT(torsion_spring<kind::frame_3D, double, double, no_rotation>)
KTE_ELEMENT(torsion_spring<kind::frame_3D, double, double, mat3<vec3<>>>)
#include <kte/elements/universal_joint.hpp>
#include <kte/elements/variable_pitch_screw_joint.hpp>
KTE_ELEMENT(variable_pitch_screw_joint<vec3<>, double, double>)
KTE_ELEMENT(placed_3D<core::variable_pitch_screw_joint<vec3<>, double, double>>)
#include <kte/elements/velocity_control.hpp>
KTE_ELEMENT(velocity_control_gen)
KTE_ELEMENT(velocity_control_2D)
KTE_ELEMENT(velocity_control_3D)
#include <kte/elements/velocity_measure.hpp>
KTE_ELEMENT(velocity_measure_gen)
KTE_ELEMENT(velocity_measure<kind::frame_2D>)
KTE_ELEMENT(velocity_measure<kind::frame_3D>)
#include <kte/elements/virtual_kte_interface.hpp>
KTE_ELEMENT(virtual_kte_interface<kind::gen>)
KTE_ELEMENT(virtual_kte_interface<kind::frame_2D>)
KTE_ELEMENT(virtual_kte_interface<kind::frame_3D>)
#include <kte/elements/vmc_revolute_joint.hpp>
KTE_ELEMENT(vmc_revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>)
KTE_ELEMENT(placed_2D<core::vmc_revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>)
KTE_ELEMENT(vmc_revolute_joint<kind::frame_3D, vec3<>>)
KTE_ELEMENT(placed_3D<core::vmc_revolute_joint<kind::frame_3D, vec3<>>>)
// clang-format on

#undef KTE_ELEMENT
#undef KTE_ELEMENT_OF_SECOND_HALF
