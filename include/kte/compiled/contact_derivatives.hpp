#pragma once

/// Part of kte/compiled.hpp: derivatives of dynamics, impacts and events of contacts.
#include <kte/compiled/models.hpp>
#include <kte/dynamics/contacts/contact_derivatives.hpp>
#include <kte/dynamics/contacts/impact_derivatives.hpp>
#include <kte/models/saltation_matrix.hpp>
