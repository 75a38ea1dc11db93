#pragma once

#include <kte/contract/key.hpp>

#include <string_view>

namespace kte::detail {

/// A coordinate that is a degree of freedom, or several: thing `slot` of its kind, whose numbers begin at place `q` of
/// a configuration and at place `v` of velocities, accelerations and forces.
struct freedom {
  kind what{};
  int slot{};
  int q{};
  int v{};
};

/// A signal that comes from outside: thing `slot` of its kind, whose numbers begin at place `u` of the input of a
/// chain. The time has no place there: -1.
struct outside_signal {
  kind what{};
  int slot{};
  int u{};
};
constexpr bool is_time(kind k, std::string_view name) { return k == kind::input && name == chain_time_::name; }

}  // namespace kte::detail
