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
  /// In lists of runtime chains, of the first of generalized coordinates in a row, each one slot and one place further
  /// than the one before: how many they are.
  int in_row = 1;
};
constexpr bool stand_in_row(const freedom& a, const freedom& b) {
  return a.what == kind::gen && b.what == kind::gen && b.slot == a.slot + 1;
}

/// An input: item `slot` of its kind, whose numbers begin at index `u` of the input of a chain; -1 for the time, which
/// is not part of u.
struct outside_signal {
  kind what{};
  int slot{};
  int u{};
};
constexpr bool is_time(kind k, std::string_view name) { return k == kind::input && name == chain_time_::name; }

}  // namespace kte::detail
