#pragma once

#include <kte/dynamics/runtime/elements.hpp>

#include <utility>

namespace kte::detail {

/// The elements of a chain, with external loads times a factor.
struct loaded_elements : runtime_elements {
  double factor;

  /// A signal that a controller writes is not an external load.
  bool is_load(int e) const {
    const auto& c = connection(e);
    bool outside = c.load;
    for (std::size_t p = 0; p < c.ports.size(); ++p)
      if (const auto k = static_cast<std::size_t>(c.ports[p].what); is_signal(c.ports[p].what))
        outside &= chain.wiring().writers[k][static_cast<std::size_t>(c.index[p])] < 0;
    return outside;
  }
  template <class State>
  void push(int e, State& s) const {
    if (factor == 1 || !is_load(e)) return runtime_elements::push(e, s);
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
