#pragma once

/// Part of kte/compiled.hpp: dynamics, impacts and derivatives with chosen contacts.
#include <kte/compiled/models.hpp>
#include <kte/dynamics/contacts/contact_derivatives.hpp>
#include <kte/dynamics/contacts/contact_jacobian.hpp>
#include <kte/dynamics/contacts/impact.hpp>
#include <kte/dynamics/contacts/impact_derivatives.hpp>
#include <kte/dynamics/contacts/operational_inertia.hpp>
#include <kte/dynamics/contacts/support_polygon.hpp>
#include <kte/dynamics/contacts/velocity_step.hpp>
#include <kte/models/saltation_matrix.hpp>
