#pragma once

#include <kte/dynamics/closed_loops/loop_results.hpp>
#include <kte/frames/contact_state.hpp>

namespace kte {

namespace detail {
template <class Values>
auto& named_value(const std::vector<std::string>& names, Values& values, std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return values[i];
  throw unknown_name("kte: this chain has no contact '" + std::string(name) + "'");
}
}  // namespace detail

/// The result of `contact_dynamics`.
struct contact_dynamics_result {
  Eigen::VectorXd a;     ///< accelerations
  bool several = false;  ///< whether other accelerations satisfy the laws of contact too; found for up to 3 contacts
                         ///< in the plane
  /// A contact: its gap, slip, force and mode. Throws `unknown_name`.
  const contact_state<>& contact(std::string_view name) const { return detail::named_value(names, contacts, name); }
  /// The force of a contact on its body, N, in axes of its surface.
  const vec3<>& force(std::string_view name) const { return contact(name).force; }

  std::vector<std::string> names;  ///< of contacts, in order
  std::vector<contact_state<>> contacts;
};

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
