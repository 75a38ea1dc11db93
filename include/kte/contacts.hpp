#pragma once

#include <kte/detail/macros_aside.hpp>

/// Contacts with friction (docs/contact.md): elements, surfaces, accelerations with contact forces, impacts.
#include <kte/contact/height_field.hpp>
#include <kte/contact/height_grid.hpp>
#include <kte/contact/surface.hpp>
#include <kte/dynamics/contacts/contact_derivatives.hpp>
#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/contacts/contact_dynamics_in_lanes.hpp>
#include <kte/dynamics/contacts/contact_jacobian.hpp>
#include <kte/dynamics/contacts/contact_jacobian_in_lanes.hpp>
#include <kte/dynamics/contacts/impact.hpp>
#include <kte/dynamics/contacts/impact_derivatives.hpp>
#include <kte/dynamics/contacts/operational_inertia.hpp>
#include <kte/dynamics/contacts/static_chains.hpp>
#include <kte/dynamics/contacts/support_polygon.hpp>
#include <kte/models/detail/static_model_at_run_time.hpp>
#include <kte/models/element_events.hpp>
#include <kte/models/moreau_jean.hpp>

#include <kte/detail/macros_back.hpp>
