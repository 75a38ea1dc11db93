// No `#pragma once`: read once for each use of KTE_ELEMENT.

/// Joints, links and mechanisms of several coordinates: what moves frames. Part of the list kte/elements/all.hpp.
#ifndef KTE_ELEMENT
#  define KTE_ELEMENT(...)
#endif

// clang-format off
#include <kte/elements/base.hpp>
KTE_ELEMENT(base<kind::gen>)
KTE_ELEMENT(base<kind::frame_2D>)
KTE_ELEMENT(base<kind::frame_3D>)
#include <kte/elements/cylindrical_joint.hpp>
#include <kte/elements/differential.hpp>
KTE_ELEMENT(differential<double, double>)
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
#include <kte/elements/fixed_joint.hpp>
#include <kte/elements/four_bar.hpp>
KTE_ELEMENT(four_bar_coupler)
KTE_ELEMENT(four_bar_rocker)
#include <kte/elements/free_joint.hpp>
KTE_ELEMENT(free_joint<kind::frame_2D>)
KTE_ELEMENT(free_joint<kind::frame_3D>)
KTE_ELEMENT(placed_2D<core::free_joint<kind::frame_2D>>)
KTE_ELEMENT(placed_3D<core::free_joint<kind::frame_3D>>)
#include <kte/elements/mimic.hpp>
KTE_ELEMENT(mimic<double, double>)
#include <kte/elements/planar_joint.hpp>
KTE_ELEMENT(planar_joint)
KTE_ELEMENT(placed_3D<core::planar_joint>)
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
#include <kte/elements/rigid_link.hpp>
KTE_ELEMENT(rigid_link_gen<double>)
KTE_ELEMENT(rigid_link<kind::frame_2D, rotation_2D<>, vec3<double, double, zero_t>>)
KTE_ELEMENT(rigid_link<kind::frame_3D, mat3<vec3<>>, vec3<>>)
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
#include <kte/elements/sticking_joint.hpp>
KTE_ELEMENT(sticking_joint<core::revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>)
KTE_ELEMENT(placed_2D<core::sticking_joint<core::revolute_joint<kind::frame_2D, vec3<zero_t, zero_t, one_t>>>>)
KTE_ELEMENT(sticking_joint<core::revolute_joint<kind::frame_3D, vec3<>>>)
KTE_ELEMENT(placed_3D<core::sticking_joint<core::revolute_joint<kind::frame_3D, vec3<>>>>)
KTE_ELEMENT(sticking_joint<core::prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>>)
KTE_ELEMENT(placed_2D<core::sticking_joint<core::prismatic_joint<kind::frame_2D, vec3<double, double, zero_t>>>>)
KTE_ELEMENT(sticking_joint<core::prismatic_joint<kind::frame_3D, vec3<>>>)
KTE_ELEMENT(placed_3D<core::sticking_joint<core::prismatic_joint<kind::frame_3D, vec3<>>>>)
#include <kte/elements/universal_joint.hpp>
#include <kte/elements/variable_pitch_screw_joint.hpp>
KTE_ELEMENT(variable_pitch_screw_joint<vec3<>, double, double>)
KTE_ELEMENT(placed_3D<core::variable_pitch_screw_joint<vec3<>, double, double>>)
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
