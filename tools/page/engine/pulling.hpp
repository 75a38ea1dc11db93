#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/port.hpp>
#include <kte/elements/driving_actuator.hpp>

/// Forces of whoever looks at a mechanism: a spring by which a frame is pulled, damping of all coordinates. They are
/// elements of a chain, so that integrators, events and Jacobians know them. Their numbers may change at any time; they
/// belong to the simulation, which outlives its chains.
namespace kte::page {

struct pull_numbers {
  vec3<> point{};        ///< in the frame, m
  vec3<> target{};       ///< in the world, m
  double stiffness = 0;  ///< N/m
  double damping = 0;    ///< N s/m
};

/// A spring and a damper between a point r of a frame and a point t that stands in the world:
///
///   F = k (R^T (t - p) - r) - c (v + w x r),  T = r x F          (1)
///
/// In the plane, what r and t have out of it does not matter.
template <kind Dim>
struct pull : no_parameters {
  static constexpr type_name type{"pull", Dim};
  static constexpr std::array<port, 1> ports{{{Dim, access::on, "frame"}}};
  static constexpr bool reads_positions = true;

  const pull_numbers* numbers;

  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    const auto r = flat(numbers->point), t = flat(numbers->target);
    const auto stretch = transpose(x.rotation) * (t - x.position) - r;
    const auto force = numbers->stiffness * stretch - numbers->damping * (x.velocity + cross(x.ang_velocity, r));
    return make_loads(wrench{force, cross(r, force)});  // (1)
  }

 private:
  static constexpr auto flat(const vec3<>& p) {
    if constexpr (Dim == kind::frame_2D) {
      return vec3{p.x, p.y, zero};
    } else {
      return p;
    }
  }
};

/// Damping of a coordinate of any kind: -c times its rates, N s/m and Nm s/rad.
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
