#pragma once

#include <kte/contract/coordinate_closure.hpp>

#include <algorithm>

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

/// The derivative of a closure of coordinates by parameter k, with its own derivatives by coordinates.
template <class Core>
struct value_by_parameter : coordinate_closure<value_by_parameter<Core>> {
  const Core& of;
  int parameter;

  template <class... Q>
  constexpr auto value(const Q&... q) const {
    return of.by_parameter(parameter, q...);
  }
};

/// Rows as numbers.
template <class S, class... R>
constexpr void put_in_numbers(const values<R...>& rows, S* to) {
  const auto numbers = rows_in_numbers<S>(rows);
  std::copy(numbers.begin(), numbers.end(), to);
}

}  // namespace kte::detail
