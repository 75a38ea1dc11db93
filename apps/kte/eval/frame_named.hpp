#pragma once

#include <kte/static_chain/static_chain.hpp>

#include <tuple>

namespace evaluate {

/// The key of a frame of a chain, by its text.
template <kte::fixed_string Text, class Gravity, class... E>
constexpr auto frame_named(const kte::static_chain<Gravity, E...>&) {
  const auto of_element = []<class Core, class... Keys>(const kte::element<Core, Keys...>*) {
    return std::tuple_cat(std::conditional_t < kte::is_frame(Keys::what) && Keys::name == Text.view(), std::tuple<Keys>,
                          std::tuple < >> {}...);
  };
  return std::get<0>(std::tuple_cat(of_element(static_cast<const E*>(nullptr))...));
}

}  // namespace evaluate
