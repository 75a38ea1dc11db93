#pragma once

/// Rigid contacts with friction (docs/contact.md): elements, accelerations with contact forces, impacts.
#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/contacts/impact.hpp>
#include <kte/dynamics/contacts/static_chains.hpp>
#include <kte/integrators/moreau_jean.hpp>
