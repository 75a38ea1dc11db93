#pragma once

#include <kte/view/scene_recording.hpp>

#include <algorithm>

namespace kte {

namespace detail {
/// At rest where all is zero; of a robot within its limits.
template <class Chain>
auto first_state(const Chain& chain) {
  if constexpr (requires { chain_in(chain).wiring(); }) {
    auto s = chain_in(chain).make_state();
    if constexpr (robot_like<Chain>)
      for (const auto& f : s.freedoms())
        if (f.what == kind::gen) {
          const auto v = static_cast<std::size_t>(f.v);
          double& q = s.template get<kind::gen>(f.slot).q;
          if (chain.limits.lower[v] <= chain.limits.upper[v])
            q = std::clamp(q, chain.limits.lower[v], chain.limits.upper[v]);
        }
    return s;
  } else {
    return make_state(chain);
  }
}
}  // namespace detail

/// The scene of a mechanism in a state, whose frames are as of the last `doMotion`.
template <drawable Chain, class State>
requires requires { typename State::scalar; }
scene scene_of(const Chain& chain, const State& s) {
  scene_recording<Chain> r(chain);
  r.row(0.0, s);
  return r.contents();
}
/// The same where all coordinates are zero; of robots within their limits.
template <drawable Chain>
scene scene_of(const Chain& chain) {
  auto s = detail::first_state(chain);
  detail::chain_in(chain).doMotion(s);
  return scene_of(chain, s);
}
/// The scene with the recordings of tables: the column t, the coordinates by the names that `kte::recorder` has for
/// them, and others, which become plots. Throws `unknown_name` for coordinates that a table has no columns of.
template <drawable Chain>
scene scene_of(const Chain& chain, const table& numbers, const recording_options& options = {}) {
  scene_recording<Chain> r(chain, options);
  auto s = detail::first_state(chain);
  r.rows(chain, s, numbers);
  return r.contents();
}

}  // namespace kte
