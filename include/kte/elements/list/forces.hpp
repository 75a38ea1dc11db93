// No `#pragma once`: read once for each use of KTE_ELEMENT.

/// Masses, springs, dampers, friction, beams and other forces. Part of the list kte/elements/all.hpp.
#ifndef KTE_ELEMENT
#  define KTE_ELEMENT(...)
#endif

// clang-format off
#include <kte/elements/bushing.hpp>
KTE_ELEMENT(bushing_3D)
#include <kte/elements/constant_force.hpp>
KTE_ELEMENT(constant_force<kind::frame_2D, vec3<double, double, zero_t>, vec3<zero_t, zero_t, double>>)
KTE_ELEMENT(constant_force<kind::frame_3D, vec3<>, vec3<>>)
KTE_ELEMENT(follower_force<kind::frame_2D, vec3<double, double, zero_t>, vec3<zero_t, zero_t, double>>)
KTE_ELEMENT(follower_force<kind::frame_3D, vec3<>, vec3<>>)
#include <kte/elements/damper.hpp>
KTE_ELEMENT(damper_gen<double>)
KTE_ELEMENT(damper<kind::frame_2D, double>)
KTE_ELEMENT(damper<kind::frame_3D, double>)
#include <kte/elements/flexible_beam.hpp>
KTE_ELEMENT(flexible_beam<kind::frame_2D>)
KTE_ELEMENT(flexible_beam<kind::frame_3D>)
#include <kte/elements/fluid_drag.hpp>
KTE_ELEMENT(fluid_drag<kind::frame_2D, double, double, vec3<double, double, zero_t>>)
KTE_ELEMENT(fluid_drag<kind::frame_3D, double, double, vec3<>>)
#include <kte/elements/force_law.hpp>
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
#include <kte/elements/joint_cubic.hpp>
KTE_ELEMENT(joint_cubic_damping_gen)
KTE_ELEMENT(joint_cubic_stiffness_gen)
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
#include <kte/elements/joint_stiction.hpp>
KTE_ELEMENT(joint_stiction_gen)
KTE_ELEMENT(brake_gen)
#include <kte/elements/joint_stiffness.hpp>
KTE_ELEMENT(joint_stiffness_gen<double, double>)
#include <kte/elements/law_spring.hpp>
#include <kte/elements/line_point_mindist.hpp>
KTE_ELEMENT(line_point_mindist<kind::frame_2D, vec3<double, double, zero_t>, vec3<double, double, zero_t>>)
KTE_ELEMENT(line_point_mindist<kind::frame_3D, vec3<>, vec3<>>)
#include <kte/elements/plane_point_mindist.hpp>
KTE_ELEMENT(plane_point_mindist<vec3<>, vec3<>>)
#include <kte/elements/rotor.hpp>
KTE_ELEMENT(rotor<vec3<>, double, double>)
#include <kte/elements/spring.hpp>
KTE_ELEMENT(spring_gen<double, double, double>)
KTE_ELEMENT(spring<kind::frame_2D, double, double, double>)
KTE_ELEMENT(spring<kind::frame_3D, double, double, double>)
#include <kte/elements/table_spring.hpp>
KTE_ELEMENT(table_spring<kind::gen, std::vector<double>>)
KTE_ELEMENT(table_spring<kind::frame_2D, std::vector<double>>)
KTE_ELEMENT(table_spring<kind::frame_3D, std::vector<double>>)
#include <kte/elements/torsion_damper.hpp>
KTE_ELEMENT(torsion_damper<kind::frame_2D, double>)
KTE_ELEMENT(torsion_damper<kind::frame_3D, double>)
#include <kte/elements/torsion_spring.hpp>
KTE_ELEMENT(torsion_spring<kind::frame_2D, double, double, double>)
KTE_ELEMENT(torsion_spring<kind::frame_3D, double, double, no_rotation>)
KTE_ELEMENT(torsion_spring<kind::frame_3D, double, double, mat3<vec3<>>>)
// clang-format on
