#pragma once

#include <kte/contract/key.hpp>

#include <string_view>

namespace kte::detail {

/// A coordinate with one or several degrees of freedom: item `slot` of its kind, with its numbers from index `q` of a
/// configuration, and from index `v` of velocities, accelerations and forces.
struct freedom {
  kind what{};
  int slot{};
  int q{};
  int v{};
  /// In lists of runtime chains: the number of generalized coordinates in a row, with consecutive slots and indices,
  /// that begins here.
  int in_row = 1;
};
constexpr bool stand_in_row(const freedom& a, const freedom& b) {
  return a.what == kind::gen && b.what == kind::gen && b.slot == a.slot + 1;
}

/// An input: item `slot` of its kind, with its numbers from index `u` of the input of a chain; -1 for the time, which
/// is not part of u.
struct outside_signal {
  kind what{};
  int slot{};
  int u{};
};
constexpr bool is_time(kind k, std::string_view name) { return k == kind::input && name == chain_time_::name; }

}  // namespace kte::detail
