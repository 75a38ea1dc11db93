#pragma once

#include <kte/contract/coordinate_closure.hpp>

/// Derivatives of closures by their own numbers, for cores that give them:
///
///   static constexpr std::array<std::string_view, N> parameter_names
///   by_parameter(k, m, order)        of frames: the derivative of residual, residual_dot or residual_ddot (order 0, 1,
///                                    2) by number k, as rows
///   by_parameter(k, q_1, q_2, ...)   of coordinates: the derivative of value
namespace kte::detail {

template <class Core>
inline constexpr bool derived_by_parameters = requires {
  Core::parameter_names;
};

/// The derivative of a closure of frames by parameter k.
template <class Core>
struct rows_by_parameter {
  const Core& of;
  int parameter;

  template <class M>
  constexpr auto residual(const M& m) const {
    return of.by_parameter(parameter, m, 0);
  }
  template <class M>
  constexpr auto residual_dot(const M& m) const {
    return of.by_parameter(parameter, m, 1);
  }
  template <class M>
  constexpr auto residual_ddot(const M& m) const {
    return of.by_parameter(parameter, m, 2);
  }
};
/// The derivative of a closure of coordinates by parameter k, with its own derivatives by coordinates.
template <class Core>
struct value_by_parameter : coordinate_closure<value_by_parameter<Core>> {
  static constexpr auto ports = Core::ports;
  const Core& of;
  int parameter;

  template <class... Q>
  constexpr auto value(const Q&... q) const {
    return of.by_parameter(parameter, q...);
  }
};

}  // namespace kte::detail
