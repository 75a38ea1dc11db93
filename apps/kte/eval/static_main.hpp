#pragma once

#include "eval/child.hpp"
#include "eval/frame_named.hpp"
#include "eval/rows.hpp"
#include "eval/static_model.hpp"

/// The main function of programs that evaluate one robot, as a type (static_program.hpp writes them).
namespace evaluate {

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
