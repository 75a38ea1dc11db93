#pragma once

#include <kte/models/modes.hpp>
#include <kte/models/vector_form.hpp>

#include "simulate/solvers.hpp"

namespace kte_tool {

/// A solver of a family of the library.
template <class Solver>
class plant_method : public plant_solver {
 public:
  /// `make` gives the solver.
  template <class Make>
  plant_method(plant& p, const Make& make) : p_(p), solver_(make()) {}

  void advance(double end, const kte::every<double>& rows, const run_observer& observe) override {
    const auto changes =
        kte::events(kte::detail::event_under_law(p_, std::get<0>(kte::element_events(p_.model()).list)))
            .report_to([this](const auto& e) {
              add_event({e.time, e.name, e.what});
            });
    solver_.integrate(end, changes, rows, observe).require_end();
  }
  double time() const override { return solver_.time(); }
  const plant::state& state() const override { return solver_.state(); }
  const kte::runtime_state& state_at(double t, const plant::state& x) override {
    if constexpr (requires { solver_.state_at(t, x); })
      return solver_.state_at(t, x);
    else
      return p_.state_at(t, x);
  }
  kte::step_statistics statistics() const override { return solver_.statistics(); }

 private:
  plant& p_;
  Solver solver_;
};

/// A method of a family, made at the start: `how` is its tolerances, or its step and options.
template <template <class, class> class Method, class... How>
std::unique_ptr<plant_solver> method(plant& p, const plant::state& x, const How&... how) {
  using solver = Method<std::reference_wrapper<plant>, plant::state>;
  return std::make_unique<plant_method<solver>>(p, [&] { return solver(std::ref(p), 0.0, x, how...); });
}

/// A solver of a multistep method, for which states are vectors.
template <template <class, class> class Method, class How>
std::unique_ptr<plant_solver> vector_method(plant& p, const plant::state& x, const How& how) {
  using form = kte::vector_form<std::reference_wrapper<plant>>;
  using solver = Method<form, plant::state>;
  return std::make_unique<plant_method<solver>>(p, [&] { return solver(form(std::ref(p)), 0.0, x, how); });
}

}  // namespace kte_tool
