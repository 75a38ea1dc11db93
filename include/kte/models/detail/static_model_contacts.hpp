#pragma once

#include <kte/dynamics/contacts/static_chains.hpp>
#include <kte/models/detail/contact_bridge.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

namespace kte::detail {

/// The contacts, and closures, of a model of a static chain; see models/detail/contact_steps.hpp.
template <class Gravity, class... E>
struct static_model_contacts<static_chain<Gravity, E...>> {
  using chain_type = static_chain<Gravity, E...>;
  using wiring = typename chain_type::wiring;
  using memory = own_memory;
  using vector = joint_vector<double, chain_type::dofs>;

  struct state_and_step {
    explicit state_and_step(const chain_type& c) : s(c), step(static_contacts<chain_type, nothing>{{{c, none}}}, s) {}
    nothing none{};
    static_contact_state<chain_type> s;
    contact_step step;
  };
  template <class Model>
  struct access {
    const Model& model;
    state_and_step& kept;

    contact_step& memory() const {
      kept.step.take_inputs(model.input());
      return kept.step;
    }
    static constexpr int contacts() { return wiring::count(kind::contact); }
    auto no_displacement() const { return Model::rate::Zero().eval(); }
    template <class X>
    bool admits(double t, const X& x, int element) const {
      return admits_contact(model, t, x, element);
    }
    template <class X, class F>
    void at(double t, const X& x, const F& f) const {
      const double *q = x.data(), *v = q + wiring::nq;
      const configuration<double, wiring, const double*> place(q);
      place.check();
      const auto bases = model.bases_at(t, v + wiring::dofs);
      bases.check();
      with(given{place, each<double, const double*>{v}, same<zero_t>{}, bases}, x, f);
    }
    template <class Given, class X, class F>
    void with(const Given& g, const X& x, const F& f) const {
      auto& s = kept.s;
      s.take(g), check_regular(model.chain(), s);
      model.each_contact([&](int i, int first) { read_mode(x, first, s.template get<kind::contact>(i)); });
      take_passing(s, s.contacts);
      f(static_contacts<chain_type, Given>{{{model.chain(), g}}}, s, s.contacts);
    }
  };
  template <class Model>
  static access<Model> of(const Model& m, memory& kept) {
    return {m, kept.template get<state_and_step>([&m] { return state_and_step(m.chain()); })};
  }
  template <class Model, class X>
  static X checked(const Model&, const X& x) {
    return x;
  }
  template <class Model>
  static void settle_at(const Model& m, memory& kept, double t) {
    of(m, kept).memory().time = t;
  }
  template <class Model, class X>
  static void begin_step(const Model& m, memory& kept, const X& x0) {
    begin_step_with_contacts(of(m, kept), x0);
  }
  template <class Model, class X>
  static void check_end(const Model&, memory&, const X&) {}
  template <class Model, class X>
  static double singular_distance(const Model&, memory&, const X&) {
    return 1;
  }
  template <class Model, class X, class Rate>
  static void settle(const Model& m, memory& kept, const X& x0, Rate& d, X& x) {
    settle_contacts(of(m, kept), x0, d, x);
  }
  template <class Model, class X, class Rate>
  static void tangential(const Model& m, memory& kept, const X& x0, Rate& e) {
    make_tangential_to_contacts(of(m, kept), x0, e);
  }
  template <class Model, class X, class At, class Bases>
  static vector accelerations(const Model& m, memory& kept, const X& x, const At& at, const double* v,
                              const Bases& bases, const vector& tau) {
    at.check(), bases.check();
    const auto access = of(m, kept);
    vector a;
    const given g{at, each<double, const double*>{v}, same<zero_t>{}, bases};
    access.with(g, x, [&](const auto& c, auto& s, contact_solver& memory) {
      accelerate_in_step(access, c, s, memory, x);
      a = s.work.forces;
    });
    check_accelerations<wiring>(a, g, tau);
    return a;
  }
  template <class Model, class X>
  static double margin(const Model& m, memory& kept, double t, const X& x, int contact, int part) {
    return contact_margins(of(m, kept), t, x)[static_cast<std::size_t>(contact)].at(part);
  }
  template <class Model, class X>
  static std::string_view resolve(const Model& m, memory& kept, double t, X& x, int event_of) {
    const auto access = of(m, kept);
    kte::detail::resolve_contacts(access, t, x, event_of);
    return access.memory().change;
  }
  template <class Model, class X>
  static double bridge(const Model& m, memory& kept, double t, X& x, double t_end, int before) {
    return bridge_contacts(of(m, kept), t, x, t_end, before);
  }
  template <class Model>
  static double length(const Model& m, memory& kept) {
    return of(m, kept).memory().at.equations.places.length;
  }
  template <class Model>
  static void let_tolerate(const Model& m, memory& kept, double of_velocity) {
    of(m, kept).memory().let_tolerate(of_velocity);
  }
  template <class Model>
  static std::string_view change(const Model& m, memory& kept) {
    return of(m, kept).memory().change;
  }
  /// The forces of closures and contacts of the last accelerations.
  template <class Model, class State>
  static void put_forces(const Model& m, memory& kept, State& s) {
    auto& own = of(m, kept).kept.s;
    for (int i = 0; i < wiring::count(kind::loop); ++i) s.template get<kind::loop>(i) = own.template get<kind::loop>(i);
    for (int i = 0; i < wiring::count(kind::contact); ++i)
      s.template get<kind::contact>(i) = own.template get<kind::contact>(i);
  }
};

}  // namespace kte::detail
