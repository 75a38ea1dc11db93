#pragma once

#include <kte/view/detail/chain_parts.hpp>
#include <kte/view/scene.hpp>

/// What scenes have of the parameters of elements.
namespace kte::view {

/// How many numbers a parameter has; 0 if there is none.
std::size_t parameter_count(const detail::element_parts& e, std::string_view name);
double number_parameter(const detail::element_parts& e, std::string_view name, double otherwise);
std::array<double, 3> vector_parameter(const detail::element_parts& e, std::string_view name,
                                       const std::array<double, 3>& otherwise);

/// Whether a rigid element without coordinates says where its end stands, and where that is.
bool has_constant_pose(const detail::element_parts& e);
scene::pose constant_pose(const detail::element_parts& e);

/// Whether a joint has a placement away from its base.
bool is_placed(const detail::element_parts& joint);
/// A vector of the placement in axes of the base.
std::array<double, 3> placement_turned(const detail::element_parts& joint, const std::array<double, 3>& v);

/// The body of an inertia: mass, centre, and the homogeneous ellipsoid of equal inertia.
scene::body body_of(const detail::element_parts& inertia);

}  // namespace kte::view
