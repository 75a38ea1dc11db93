#pragma once

#include <kte/dynamics/closed_loops/static_chains.hpp>
#include <kte/models/detail/loop_steps.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

namespace kte::detail {

/// The loops of a model of a static chain; see models/detail/loop_steps.hpp.
template <class Gravity, class... E>
struct static_model_loops<static_chain<Gravity, E...>> {
  using chain_type = static_chain<Gravity, E...>;
  using wiring = typename chain_type::wiring;
  using memory = own_memory;
  using vector = joint_vector<double, chain_type::dofs>;

  /// Positions, for messages.
  struct positions {
    joint_vector<double, wiring::nq> numbers;
    template <int I>
    double at() const {
      return numbers[I];
    }
  };
  struct named {
    struct {
      positions q;
    } at;
  };
  using closures_type = static_closures<chain_type, named>;
  struct state_and_step {
    explicit state_and_step(const chain_type& c) : s(c), step(closures_type{{c, here}}, s) {}
    static_loop_state<chain_type> s;
    named here{};
    loop_step step;
  };
  template <class Model>
  struct access {
    const Model& model;
    state_and_step& kept;

    static constexpr bool inputs_move() { return false; }
    closures_type closures() const { return {{model.chain(), kept.here}}; }
    auto& state() const { return kept.s; }
    loop_workspace& workspace() const { return kept.s.loops; }
    loop_step& step() const { return kept.step; }
    template <class X>
    void put(const X& x) const {
      const double *q = x.data(), *v = q + wiring::nq;
      const configuration<double, wiring, const double*> at(q);
      at.check();
      std::copy_n(q, wiring::nq, kept.here.at.q.numbers.data());
      kept.s.take(
          given{at, each<double, const double*>{v}, same<zero_t>{}, model.bases_at(kept.step.time, v + wiring::dofs)});
      check_regular(model.chain(), kept.s);
    }
    template <class X>
    void put_positions(const X& x) const {
      put(x);
    }
  };
  template <class Model>
  static access<Model> of(const Model& m, memory& kept) {
    return {m, kept.template get<state_and_step>([&m] { return state_and_step(m.chain()); })};
  }
  /// Raises `bad_argument` for what the model does not support.
  static void check_chain(const chain_type& c) {
    const named here{};
    const static_loop_state<chain_type> s(c);
    check_model_of_loops(closures_type{{c, here}}, s, s.loops.equations.places, false);
  }
  template <class Model, class X>
  static X checked(const Model& m, const X& x) {
    return checked_on_loops(m, x);
  }
  template <class Model>
  static void settle_at(const Model& m, memory& kept, double t) {
    of(m, kept).step().time = t;
  }
  template <class Model, class X>
  static void begin_step(const Model& m, memory& kept, const X& x0) {
    check_step(of(m, kept), x0);
  }
  template <class Model, class X>
  static void check_end(const Model& m, memory& kept, const X& x0) {
    check_step_end(of(m, kept), x0);
  }
  template <class Model, class X>
  static double singular_distance(const Model& m, memory& kept, const X& x0) {
    return singular_distance_of(of(m, kept), x0);
  }
  template <class Model, class X, class Rate>
  static void settle(const Model& m, memory& kept, const X& x0, Rate& d, X& x) {
    settle_on_loops(of(m, kept), x0, d, x);
  }
  template <class Model, class X, class Rate>
  static void tangential(const Model& m, memory& kept, const X& x0, Rate& e) {
    make_tangential(of(m, kept), x0, e);
  }
  template <class Model, class X, class At, class Bases>
  static vector accelerations(const Model& m, memory& kept, const X&, const At& at, const double* v, const Bases& bases,
                              const vector& tau) {
    at.check(), bases.check();
    const auto loops = of(m, kept);
    auto& s = loops.state();
    const given g{at, each<double, const double*>{v}, same<zero_t>{}, bases};
    s.take(g), check_regular(m.chain(), s);
    static_loops<chain_type>::accelerate(static_closures<chain_type, std::remove_const_t<decltype(g)>>{{m.chain(), g}},
                                         s, g, tau, rows_of_stage(loops));
    note_stage(loops);
    return s.work.forces;
  }
  /// The closure forces of the last accelerations.
  template <class Model, class State>
  static void put_forces(const Model& m, memory& kept, State& s) {
    auto& own = of(m, kept).state();
    for (int i = 0; i < wiring::count(kind::loop); ++i)
      s.template get<kind::loop>(i).force = own.template get<kind::loop>(i).force,
                 s.template get<kind::loop>(i).torque = own.template get<kind::loop>(i).torque;
  }
};

}  // namespace kte::detail
