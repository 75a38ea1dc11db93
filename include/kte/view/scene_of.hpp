#pragma once

#include <kte/view/scene_recording.hpp>

#include <algorithm>

namespace kte {

namespace detail {
/// Puts a robot into the first configuration of its file, or where all is zero within its limits.
template <robot_like Robot>
void put_first(const Robot& r, runtime_state& s) {
  for (const auto& f : s.freedoms()) {
    const auto v = static_cast<std::size_t>(f.v);
    with_coordinate(s, f.what, f.slot, [&](auto& c) {
      auto q = static_cast<std::size_t>(f.q);
      visit_q(c, [&](double& x) {
        if (!r.configurations.empty())
          x = r.configurations.front().q[q++];
        else if (f.what == kind::gen && r.limits.lower[v] <= r.limits.upper[v])
          x = std::clamp(x, r.limits.lower[v], r.limits.upper[v]);
      });
    });
  }
}
/// At rest where all is zero, of a robot where it stands at first.
template <class Chain>
auto first_state(const Chain& chain) {
  if constexpr (requires { chain_in(chain).wiring(); }) {
    auto s = chain_in(chain).make_state();
    if constexpr (robot_like<Chain>) put_first(chain, s);
    return s;
  } else {
    return make_state(chain);
  }
}
}  // namespace detail

/// The scene of a mechanism in a state, with the frames of the last `doMotion`.
template <drawable Chain, class State>
requires requires { typename State::scalar; }
scene scene_of(const Chain& chain, const State& s) {
  scene_recording<Chain> r(chain);
  r.row(0.0, s);
  return r.contents();
}
/// The scene of a mechanism with all coordinates zero; of robots in the first configuration of their file, or within
/// their limits.
template <drawable Chain>
[[nodiscard]] scene scene_of(const Chain& chain) {
  auto s = detail::first_state(chain);
  detail::chain_in(chain).doMotion(s);
  return scene_of(chain, s);
}
/// The scene with the recording of a table: the column t, the coordinates by their names in `kte::recorder`; other
/// columns become plots. Throws `unknown_name` for coordinates without columns.
template <drawable Chain>
[[nodiscard]] scene scene_of(const Chain& chain, const table& numbers, const recording_options& options = {}) {
  scene_recording<Chain> r(chain, options);
  auto s = detail::first_state(chain);
  r.rows(chain, s, numbers);
  return r.contents();
}

}  // namespace kte
