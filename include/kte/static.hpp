#pragma once

/// Static chains and the algorithms on them: no heap, no virtual calls; builds without exceptions and RTTI.
#include <kte/chain/checks.hpp>
#include <kte/chain/layout.hpp>
#include <kte/chain/static_chain.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/elements/base.hpp>
#include <kte/elements/damper.hpp>
#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/elements/torsion_damper.hpp>
#include <kte/elements/torsion_spring.hpp>
#include <kte/frames/inverse.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/math/eigen.hpp>
#include <kte/math/quaternion.hpp>
