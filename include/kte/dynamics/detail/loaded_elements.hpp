#pragma once

#include <kte/dynamics/detail/runtime_loops.hpp>

#include <utility>

namespace kte::detail {

/// The elements of a chain, loads from outside times a factor.
struct loaded_elements : runtime_elements {
  double factor;

  template <class State>
  void push(int e, State& s) const {
    if (!connection(e).load || factor == 1) return runtime_elements::push(e, s);
    const kind k = ports(e).front().what;
    const int at = index(e, 0);
    if (k == kind::gen) {
      auto& x = s.template get<kind::gen>(at);
      const auto before = std::exchange(x.f, typename State::scalar(0));
      runtime_elements::push(e, s);
      x.f = before + factor * x.f;
      return;
    }
    with_frame(s, k, at, [&](auto& x) {
      using S = typename State::scalar;
      const auto force = x.force;
      const auto torque = x.torque;
      clear_load(x);
      runtime_elements::push(e, s);
      x.force = force + S(factor) * x.force, x.torque = torque + S(factor) * x.torque;
    });
  }
};

}  // namespace kte::detail
