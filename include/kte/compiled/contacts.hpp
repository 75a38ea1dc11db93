#pragma once

/// Part of kte/compiled.hpp: dynamics and impacts with contacts.
#include <kte/compiled/loops.hpp>
#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/contacts/contact_jacobian.hpp>
#include <kte/dynamics/contacts/impact.hpp>
#include <kte/dynamics/contacts/mode_dynamics.hpp>
#include <kte/dynamics/contacts/operational_inertia.hpp>
#include <kte/dynamics/contacts/support_polygon.hpp>
#include <kte/dynamics/contacts/velocity_step.hpp>
