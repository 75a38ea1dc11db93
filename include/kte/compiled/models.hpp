#pragma once

/// Part of kte/compiled.hpp: runtime chains as systems x' = f(t, x), solvers, arms; derivatives of dynamics, impacts
/// and events of contacts.
#include <kte/compiled/contacts.hpp>
#include <kte/dynamics/contacts/contact_derivatives.hpp>
#include <kte/dynamics/contacts/impact_derivatives.hpp>
#include <kte/integrators/detail/weakly_damped.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/runtime_models.hpp>
#include <kte/models/saltation_matrix.hpp>
