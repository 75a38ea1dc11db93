#pragma once

#include <kte/contract/transmission.hpp>
#include <kte/detail/numbers_where.hpp>

#include <utility>

/// Elements without loads.
namespace kte::detail {

template <kind K>
constexpr auto no_load() {
  if constexpr (K == kind::gen) {
    return zero;
  } else {
    return no_wrench;
  }
}

/// A core without loads.
template <class Core>
struct no_load_core {
  static constexpr auto& type = Core::type;
  static constexpr auto& ports = Core::ports;

  template <class... Inputs>
  KTE_INLINE constexpr auto doForce(const Inputs&...) const {
    return loads();
  }
  KTE_INLINE static constexpr auto loads() {
    return []<std::size_t... P>(std::index_sequence<P...>) KTE_INLINE_LAMBDA {
      return make_loads(no_load<Core::ports[P].what>()...);
    }
    (typename numbers_where<takes_load>::type{});
  }

 private:
  /// Whether each port takes a load: ports that are not signals.
  static constexpr auto takes_load = [] {
    std::array<bool, port_count<Core>> is{};
    for (std::size_t p = 0; p < input_count<Core>; ++p) is[p] = !is_signal(Core::ports[p].what);
    return is;
  }();
};

/// The type of its loads.
template <class Core>
struct no_loads {
  using type = decltype(no_load_core<Core>::loads());
};

}  // namespace kte::detail
