#pragma once

#include <kte/contract/transmission.hpp>

#include <boost/hana/flatten.hpp>

#include <utility>

/// Elements that put no loads.
namespace kte::detail {

template <kind K>
constexpr auto no_load() {
  if constexpr (K == kind::gen) {
    return zero;
  } else {
    return no_wrench;
  }
}

/// An element that puts no loads.
template <class Core>
struct silent {
  static constexpr auto& type = Core::type;
  static constexpr auto& ports = Core::ports;

  template <class... Inputs>
  KTE_INLINE constexpr auto doForce(const Inputs&...) const {
    return none(std::make_index_sequence<sizeof...(Inputs)>{});
  }

  template <std::size_t... P>
  KTE_INLINE static constexpr auto none(std::index_sequence<P...>) {
    return boost::hana::flatten(boost::hana::make_tuple(none<P>()...));
  }

 private:
  template <std::size_t P>
  KTE_INLINE static constexpr auto none() {
    if constexpr (is_signal(Core::ports[P].what)) {
      return boost::hana::tuple<>{};
    } else {
      return boost::hana::make_tuple(no_load<Core::ports[P].what>());
    }
  }
};

/// The type of what it puts.
template <class Core>
struct no_loads {
  using type = decltype(silent<Core>::none(std::make_index_sequence<input_count<Core>>{}));
};

}  // namespace kte::detail
