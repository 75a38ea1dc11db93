#pragma once

#include <kte/dynamics/runtime/at_run_time.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

namespace kte::detail {

/// A model of a runtime chain for a model of any chain, with its inputs.
inline const auto& model_at_run_time(const manipulator_dynamics_model<runtime_chain>& m) { return m; }
template <class Gravity, class... E, class Output>
auto model_at_run_time(const manipulator_dynamics_model<static_chain<Gravity, E...>, double, Output>& m) {
  manipulator_dynamics_model<runtime_chain> made(with_texts(m.chain()));
  made.setInput(m.input());
  return made;
}

/// What a model of a static chain with closures or contacts keeps: the model of the same chain at run time, which does
/// its work.
template <class Gravity, class... E>
struct static_model_at_run_time<static_chain<Gravity, E...>> {
  using runtime_model = manipulator_dynamics_model<runtime_chain>;
  struct memory {
    runtime_model model;
    Eigen::VectorXd x, x0, d;
  };

  template <class Model>
  explicit static_model_at_run_time(const Model& m)
      : kept_(m.constraints_.template get<memory>([&m] {
          return memory{runtime_model(with_texts(m.chain())), {}, {}, {}};
        })) {
    if constexpr (Model::chain_type::wiring::nu > 0) kept_.model.setInput(m.input());
  }
  runtime_model& model() const { return kept_.model; }
  /// x in a vector of dynamic size.
  template <class X>
  Eigen::VectorXd& at(const X& x) const {
    return kept_.x = x;
  }
  // ---- functions of the model with results of fixed size
  template <class X, class Rate>
  void settle(const X& x0, Rate& d, X& x) const {
    kept_.x0 = x0, kept_.d = d;
    kept_.model.settle(kept_.x0, kept_.d, at(x));
    d = kept_.d, x = kept_.x;
  }
  template <class X, class Rate>
  void tangential(const X& x0, Rate& e) const {
    kept_.d = e;
    kept_.model.tangential(at(x0), kept_.d);
    e = kept_.d;
  }
  /// x, or of chains with loops x on them.
  template <class X>
  X checked(const X& x) const {
    const runtime_model& m = kept_.model;
    const Eigen::VectorXd q = m.positions_of(x), v = m.velocities_of(x), z = m.internals_of(x);
    return m.make_x(q, v, z);
  }
  template <class X>
  std::string_view resolve_contacts(double t, X& x, int event_of) const {
    const auto change = kept_.model.resolve_contacts(t, at(x), event_of);
    x = kept_.x;
    return change;
  }
  template <class X>
  double bridge_contacts(double t, X& x, double t_end, int before) const {
    const double after = kept_.model.bridge_contacts(t, at(x), t_end, before);
    x = kept_.x;
    return after;
  }
  /// Writes the accelerations, and the states of closures and contacts, to a state of the static chain.
  template <class X, class State>
  void put_dynamics(double t, const X& x, State& s) const {
    const runtime_state& from = kept_.model.state_at(t, at(x));
    set_accelerations(s, accelerations(from));
    put_constraints(from, s);
  }
  template <class State>
  static void put_constraints(const runtime_state& from, State& s) {
    for (int i = 0; i < State::wiring::count(kind::loop); ++i) s.template get<kind::loop>(i) = from.get<kind::loop>(i);
    for (int i = 0; i < State::wiring::count(kind::contact); ++i)
      s.template get<kind::contact>(i) = from.get<kind::contact>(i);
  }

 private:
  memory& kept_;
};

}  // namespace kte::detail
