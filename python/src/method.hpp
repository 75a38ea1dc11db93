#pragma once

#include "solvers.hpp"

namespace kte_python {

/// A solver of a family of the library.
template <class Solver>
class method : public any_solver {
 public:
  /// `make` gives the solver.
  template <class Make>
  method(plant& p, const Make& make) : p_(p), solver_(make()) {}

  report advance(double end, const event_lists& events, const sampling& at, const observer& observe) override {
    report r;
    const auto all = kte::events(events.plain, events.acting,
                                 kte::detail::event_under_law(p_, std::get<0>(kte::element_events(p_.model()).list)))
                         .report_to([&r](const kte::event_occurrence<plant::state>& e) { r.events.push_back(e); });
    const auto ended = at.every_step ? solver_.integrate(end, all, observe)
                                     : solver_.integrate(end, all, kte::at(at.times).with_event_rows(), observe);
    r.count = ended.count, r.reason = ended.reason;
    r.stopped_by = ended.stopped_by, r.stopped_by_name = ended.stopped_by_name;
    return r;
  }
  double time() const override { return solver_.time(); }
  const plant::state& state() const override { return solver_.state(); }
  void restart(double t, const plant::state& x) override { solver_.restart(t, x); }
  kte::step_statistics statistics() const override { return solver_.statistics(); }
  const kte::runtime_state* state_at([[maybe_unused]] double t, [[maybe_unused]] const plant::state& x) override {
    if constexpr (requires { solver_.state_at(t, x); })
      return &solver_.state_at(t, x);
    else
      return nullptr;
  }

 private:
  plant& p_;
  Solver solver_;
};

/// A method of a family: `how` is its tolerances, or its step and options.
template <template <class, class> class Method, class... How>
std::unique_ptr<any_solver> solver_of(plant& p, const plant::state& x, double t, const How&... how) {
  using solver = Method<std::reference_wrapper<plant>, plant::state>;
  return std::make_unique<method<solver>>(p, [&] { return solver(std::ref(p), t, x, how...); });
}
/// A multistep method, which moves states as vectors.
template <template <class, class> class Method, class How>
std::unique_ptr<any_solver> vector_solver_of(plant& p, const plant::state& x, double t, const How& how) {
  using form = kte::vector_form<std::reference_wrapper<plant>>;
  using solver = Method<form, plant::state>;
  return std::make_unique<method<solver>>(p, [&] { return solver(form(std::ref(p)), t, x, how); });
}

}  // namespace kte_python
