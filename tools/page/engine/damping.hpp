#pragma once

#include <kte/view/pull.hpp>

namespace kte::page {

/// Damping of a coordinate of any kind, which belongs to the simulation: -c times its rates, N s/m and Nm s/rad.
template <kind What>
struct coordinate_damping : no_parameters {
  static constexpr type_name type{"page_damping", What};
  static constexpr std::array<port, 1> ports{{{What, access::on, "coordinate"}}};

  const double* damping;

  template <class C>
  constexpr auto doForce(const C& c) const {
    if constexpr (What == kind::gen) {
      return make_loads(-(*damping * c.q_dot));
    } else {
      return make_loads(wrench{-(*damping * c.velocity), -(*damping * c.ang_velocity)});
    }
  }
};

}  // namespace kte::page
