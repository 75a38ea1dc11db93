#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/elements/base.hpp>
#include <kte/elements/damper.hpp>
#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/joint_backlash.hpp>
#include <kte/elements/joint_lugre.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/elements/torsion_damper.hpp>
#include <kte/elements/torsion_spring.hpp>
#include <kte/runtime_chain/kte_map_adapter.hpp>

/// The elements of this library in runtime chains, of plain numbers and of unit axes: those that files have.
#ifdef KTE_EXTERN
namespace kte {

#  define KTE_ELEMENT(...) KTE_EXTERN template class kte_map_adapter<core::__VA_ARGS__>
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
KTE_ELEMENT(inertia_gen<double>);
KTE_ELEMENT(inertia<kind::frame_2D, double, vec3<double, double, zero_t>,
                    sym3<zero_t, zero_t, zero_t, zero_t, zero_t, double>>);
KTE_ELEMENT(inertia<kind::frame_3D, double, vec3<>, sym3<>>);
KTE_ELEMENT(spring_gen<double, double, double>);
KTE_ELEMENT(spring<kind::frame_2D, double, double, double>);
KTE_ELEMENT(spring<kind::frame_3D, double, double, double>);
KTE_ELEMENT(damper_gen<double>);
KTE_ELEMENT(damper<kind::frame_2D, double>);
KTE_ELEMENT(damper<kind::frame_3D, double>);
KTE_ELEMENT(torsion_spring<kind::frame_2D, double, double, double>);
KTE_ELEMENT(torsion_spring<kind::frame_3D, double, double, zero_t>);
KTE_ELEMENT(torsion_damper<kind::frame_2D, double>);
KTE_ELEMENT(torsion_damper<kind::frame_3D, double>);
KTE_ELEMENT(driving_actuator_gen);
KTE_ELEMENT(joint_lugre_gen);
KTE_ELEMENT(joint_backlash_gen<double>);
#  undef KTE_ELEMENT

}  // namespace kte
#endif
