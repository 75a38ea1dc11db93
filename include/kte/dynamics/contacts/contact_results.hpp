#pragma once

#include <kte/dynamics/closed_loops/loop_results.hpp>
#include <kte/frames/contact_state.hpp>

#include <array>

namespace kte {

namespace detail {
template <class S>
struct truth_of_lanes_as {
  using type = bool;
};
template <class S>
requires(S::lanes > 0) struct truth_of_lanes_as<S> {
  using type = std::array<bool, std::size_t{S::lanes}>;
};
/// A truth value; of packs an array of them, by lane.
template <class S>
using truth_of_lanes = typename truth_of_lanes_as<S>::type;
template <class Values>
auto& named_value(const std::vector<std::string>& names, Values& values, std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return values[i];
  throw unknown_name("kte: this chain has no contact '" + std::string(name) + "'");
}
}  // namespace detail

/// The result of `contact_dynamics`. S: double, or packs of states.
template <class S>
struct basic_contact_dynamics_result {
  Eigen::Matrix<S, Eigen::Dynamic, 1> a;  ///< accelerations
  /// Whether other accelerations satisfy the laws of contact too; found for up to 3 contacts in the plane. Of packs an
  /// array, by lane.
  detail::truth_of_lanes<S> several{};
  /// A contact: its gap, slip, force and mode. Throws `unknown_name`.
  const contact_state<S>& contact(std::string_view name) const { return detail::named_value(names, contacts, name); }
  /// The force of a contact on its body, N, in axes of its surface.
  const vec3<S>& force(std::string_view name) const { return contact(name).force; }

  std::vector<std::string> names;  ///< of contacts, in order
  std::vector<contact_state<S>> contacts;
};
/// The result of `contact_dynamics` in double.
using contact_dynamics_result = basic_contact_dynamics_result<double>;

/// The result of `impact`.
struct impact_result {
  Eigen::VectorXd v;       ///< velocities after the impact
  double energy = 0;       ///< change of the kinetic energy, J; never positive
  double restitution = 1;  ///< the factor of all coefficients of restitution that keeps energy from growing
  /// The impulse of a contact on its body, Ns, in axes of its surface. Throws `unknown_name`.
  const vec3<>& impulse(std::string_view name) const { return detail::named_value(names, impulses, name); }

  std::vector<std::string> names;  ///< of contacts, in order
  std::vector<vec3<>> impulses;
};

}  // namespace kte
