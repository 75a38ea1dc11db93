#pragma once

#include <kte/dynamics/looped/forward_dynamics.hpp>
#include <kte/dynamics/runtime/elements.hpp>

namespace kte::detail {

template <class State>
void general_dynamics<State>::bring() {
  known.store(
      [](const runtime_chain& c, State& s, const tree::given_forces<double>& tau, std::span<const char> prescribed,
         bool tree) { accelerate_generally(runtime_elements{c}, s, tau, prescribed, tree); },
      std::memory_order_relaxed);
}

#ifdef KTE_EXTERN
KTE_EXTERN template struct general_dynamics<runtime_state>;
#  ifdef KTE_FUNCTION
inline const bool general_dynamics_is_known = (general_dynamics<runtime_state>::bring(), true);  // to all units
#  endif
#endif

#ifdef KTE_FUNCTION
/// Throws `bad_argument` with the first coordinate that moves two joints.
[[noreturn, gnu::cold]] KTE_FUNCTION void refuse_shared_coordinates(const runtime_chain& c) {
  std::vector<std::string_view> seen;
  for (const auto& e : c.wiring().elements)
    for (std::size_t p = 0; e.rigid && is_coordinate(e.ports[p].what); ++p) {
      const std::string_view name =
          c.wiring().names[static_cast<std::size_t>(e.ports[p].what)][static_cast<std::size_t>(e.index[p])];
      if (std::find(seen.begin(), seen.end(), name) != seen.end())
        throw bad_argument("kte: '" + std::string(name) +
                           "' moves several joints: forward dynamics of such a chain needs #include "
                           "<kte/shared_coordinates.hpp>");
      seen.push_back(name);
    }
  throw bad_argument("kte: forward dynamics of this chain needs #include <kte/shared_coordinates.hpp>");
}
KTE_FUNCTION void runtime_elements::accelerate_generally(runtime_state& s, const tree::given_forces<double>& tau,
                                                         std::span<const char> prescribed, bool tree) const {
#  ifdef KTE_EXTERN
  detail::accelerate_generally(*this, s, tau, prescribed, tree);
#  else
  const auto accelerate = general_dynamics<runtime_state>::known.load(std::memory_order_relaxed);
  if (accelerate == nullptr) refuse_shared_coordinates(chain);
  accelerate(chain, s, tau, prescribed, tree);
#  endif
}
#endif

}  // namespace kte::detail
