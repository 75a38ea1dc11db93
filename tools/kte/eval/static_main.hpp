#pragma once

#include "eval/child.hpp"
#include "eval/rows.hpp"
#include "eval/static_model.hpp"

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

/// The arguments are the number of a pipe on which it says that it has done all (child.hpp), the file of states, the
/// names of operations, and 1 for derivatives or 0.
template <class S, class Chain, class... Frames>
int static_main(int count, char** arguments, const Chain& chain, const std::vector<std::string>& coordinates,
                const Frames&...) {
  if (count != 5) return 2;
  const int code = kte::detail::exit_code_of([&] {
    options o;
    o.states = arguments[2], o.ops = arguments[3], o.derivatives = arguments[4] == std::string_view("1");
    if constexpr (!std::is_same_v<S, double>) o.digits = 50;
    static_model<S, Chain, Frames...> model(chain);
    print_rows(model, state_table(o.states), coordinates, o);
    return 0;
  });
  confirm_end(arguments[1]);
  return code;
}

}  // namespace evaluate
