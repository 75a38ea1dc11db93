#pragma once

/// All of kte but files: elements, static and runtime chains, dynamics, integrators. Files need `kte/io.hpp`.
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/runtime.hpp>
#include <kte/elements/base.hpp>
#include <kte/elements/damper.hpp>
#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/spring.hpp>
