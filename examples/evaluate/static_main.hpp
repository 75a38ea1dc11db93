#pragma once

#include "evaluate/rows.hpp"
#include "evaluate/static_model.hpp"

/// The main function of programs that evaluate one robot, as a type (static_program.hpp writes them).
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

template <class S, class Chain, class... Frames>
int static_main(int count, char** arguments, const Chain& chain, const std::vector<std::string>& coordinates,
                const Frames&...) {
  try {
    const auto o = read_options(count, arguments);
    static_model<S, Chain, Frames...> model(chain);
    print_rows(model, state_table(o.states), coordinates, o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}

}  // namespace evaluate
