#pragma once

#include <kte/integrators/adams.hpp>
#include <kte/integrators/adams_BM.hpp>
#include <kte/integrators/bdf.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/implicit_midpoint.hpp>
#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>
#include <kte/integrators/semi_implicit_euler.hpp>
#include <kte/integrators/stormer_verlet.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>

#include "problem.hpp"

namespace work_precision {

/// f is shared, not copied.
template <template <class, class> class Method, class F, class X>
class integration final : public contender {
  using solver_type = Method<std::reference_wrapper<const F>, X>;
  using tolerances = kte::tolerances<double>;

 public:
  static constexpr bool adaptive =
      std::is_constructible_v<solver_type, std::reference_wrapper<const F>, double, X, tolerances>;

  integration(const std::string& name, double ratio, const F& f, const task<X>& t)
      : contender(name, adaptive ? 0 : ratio), f_(f), task_(t), end_(t.start) {}

  [[gnu::noinline]] void integrate(double setting) override {
    cost = {};
    if constexpr (adaptive) {
      go(solver_type(std::cref(f_), 0.0, task_.start, tolerances_of(setting)));
    } else {
      go(solver_type(std::cref(f_), 0.0, task_.start, setting));
    }
  }
  judgement judge() const override { return task_.judge(end_); }

 private:
  tolerances tolerances_of(double setting) const {
    if (task_.sizes.size() == 0) return {setting, setting, most_steps};
    return {(setting * task_.sizes).eval(), setting, most_steps};
  }
  void go(solver_type solver) {
    try {
      solver.integrate(task_.t_end);
    } catch (...) {
      cost = solver.statistics();
      throw;
    }
    end_ = solver.state();
    cost = solver.statistics();
  }

  static constexpr long long most_steps = 3'000'000;
  const F& f_;
  task<X> task_;
  X end_;
};

/// The integrators for one right-hand side f, which must live as long; `suffix` is added to their names.
template <class F, class X>
class entrants {
 public:
  entrants(problem& p, const F& f, const task<X>& t, std::string suffix = "")
      : problem_(p), f_(f), task_(t), suffix_(std::move(suffix)) {}

  template <template <class, class> class Method>
  void add(const char* name, double ratio = 2) const {
    problem_.contenders.push_back(std::make_unique<integration<Method, F, X>>(name + suffix_, ratio, f_, task_));
  }
  void add_embedded() const {
    add<kte::dormand_prince45>("dormand_prince45");
    add<kte::prince_dormand87>("prince_dormand87");
  }
  void add_fixed() const {
    add<kte::euler>("euler", 4);
    add<kte::midpoint>("midpoint", 4);
    add<kte::runge_kutta4>("runge_kutta4");
    add<kte::runge_kutta5>("runge_kutta5");
  }
  void add_adams() const {
    add<kte::adams>("adams");
    add<kte::adams_BM3>("adams_BM3");
    add<kte::adams_BM5>("adams_BM5");
  }
  /// Those that keep something of a mechanism.
  void add_structured() const {
    add<kte::semi_implicit_euler>("semi_implicit_euler", 4);
    add<kte::stormer_verlet>("stormer_verlet", 4);
    add<kte::implicit_midpoint>("implicit_midpoint", 4);
  }
  void add_stiff_one_step() const {
    add<kte::rosenbrock23>("rosenbrock23");
    add<kte::rodas>("rodas");
    add<kte::tr_bdf2>("tr_bdf2");
    add<kte::trapezoidal>("trapezoidal");
    add<kte::kennedy_carpenter34>("kennedy_carpenter34");
  }
  void add_stiff() const {
    add_stiff_one_step();
    add<kte::bdf>("bdf");
  }
  /// All for vectors that are not stiff, but for those that keep something.
  void add_explicit() const { add_embedded(), add_adams(), add_fixed(); }

 private:
  problem& problem_;
  const F& f_;
  task<X> task_;
  std::string suffix_;
};

}  // namespace work_precision
