#pragma once

#include <string>
#include <utility>

#include "serial_robot.hpp"
#include "timing.hpp"

/// Other libraries on the same robots. Each is built from the numbers of serial_robot.hpp and has a file here; its
/// `error` against the same digits shows that it is the same robot. Calls put the arguments in, evaluate no more than
/// is requested, and copy the results.
namespace bench::peers {

inline constexpr const char* models[]{"pendulum", "iiwa14", "ur5", "serial2", "serial8", "serial32", "serial128"};

/// Registers Subject<M>, M counting the models, under the name Subject::how: those calls that it has, for
/// models that it `builds`, if it says so.
template <template <int> class Subject>
void add_all() {
  const auto add_model = []<int M>(std::integral_constant<int, M>) {
    using calls = Subject<M>;
    const std::string model = models[M], how = calls::how;
    if constexpr (requires { calls::builds(model); })
      if (!calls::builds(model)) return;
    if constexpr (requires { calls::forward_kinematics; })
      if (M != 0)  // of the pendulum four numbers are expected
        add<double>(operation::forward_kinematics, how, model, calls::forward_kinematics);
    if constexpr (requires { calls::jacobian; }) add<double>(operation::jacobian, how, model, calls::jacobian);
    if constexpr (requires { calls::inverse_dynamics; })
      add<double>(operation::inverse_dynamics, how, model, calls::inverse_dynamics);
    if constexpr (requires { calls::mass_matrix; }) add<double>(operation::mass_matrix, how, model, calls::mass_matrix);
    if constexpr (requires { calls::forward_dynamics; })
      add<double>(operation::forward_dynamics, how, model, calls::forward_dynamics);
    if (model == "serial128") return;  // results that grow by the square are expected of shorter ones
    if constexpr (requires { calls::mass_matrix_inverse; })
      add<double>(operation::mass_matrix_inverse, how, model, calls::mass_matrix_inverse);
    if constexpr (requires { calls::id_derivatives; })
      add<double>(operation::id_derivatives, how, model, calls::id_derivatives);
    if constexpr (requires { calls::fd_derivatives; })
      add<double>(operation::fd_derivatives, how, model, calls::fd_derivatives);
  };
  [&]<int... M>(std::integer_sequence<int, M...>) { (add_model(std::integral_constant<int, M>{}), ...); }
  (std::make_integer_sequence<int, int{std::size(models)}>{});
}

}  // namespace bench::peers
