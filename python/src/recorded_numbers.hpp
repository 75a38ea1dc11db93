#pragma once

#include <kte/dynamics/energy.hpp>
#include <kte/io/recording.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace kte_python {

/// Quantities of a chain by name, for sweeps. Throws `unknown_name` for unknown ones, and for the time, which is that
/// of the run.
inline kte::detail::recording kept_quantities(const kte::runtime_chain& c, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), "t") != names.end())
    throw kte::unknown_name("kte: cannot keep 't', the time: 'run/end_time' of a simulation is its end");
  return {kte::detail::slots_of(c), names, kte::detail::energy_columns::allowed};
}

/// The numbers of these cells in a state of the chain, also energies.
inline void read_numbers(const std::vector<kte::detail::recorded>& cells, const kte::runtime_chain& c,
                         const kte::runtime_state& s, double* out) {
  kte::detail::read_recorded(cells, s, out);
  if (std::none_of(cells.begin(), cells.end(), [](const auto& x) { return x.is_energy(); })) return;
  auto own = s;  // energies use its memory
  const auto e = kte::energy(c, own);
  const std::array<double, 3> energies{e.kinetic, e.potential, e.kinetic + e.potential};
  for (const auto& x : cells) {
    if (x.is_energy()) *out = energies[x.quantity];
    out += x.count;
  }
}

}  // namespace kte_python
