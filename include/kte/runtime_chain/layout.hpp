#pragma once

#include <kte/runtime_chain/chain.hpp>
#include <kte/static_chain/layout.hpp>

#include <string>
#include <vector>

namespace kte {

/// The layout of a chain: the positions of its coordinates in q and v.
[[nodiscard]] inline std::vector<layout_entry<std::string>> layout(const runtime_chain& c) {
  std::vector<layout_entry<std::string>> table;
  for (const auto& f : c.wiring().free)
    table.push_back({c.wiring().names[static_cast<std::size_t>(f.what)][static_cast<std::size_t>(f.slot)], f.what, f.q,
                     nq_of(f.what), f.v, nv_of(f.what)});
  return table;
}

}  // namespace kte

#include <kte/runtime_chain.hpp>
