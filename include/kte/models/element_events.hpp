#pragma once

#include <kte/contract/closure.hpp>
#include <kte/events/events.hpp>
#include <kte/models/controlled.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

#include <algorithm>
#include <cmath>

namespace kte {

namespace detail {
/// An element of a static chain in messages.
template <class Element>
struct described;
template <class Core, class... Keys>
struct described<element<Core, Keys...>> {
  static std::string name() {
    return describe_element(Core::type, Core::ports, std::array<std::string_view, sizeof...(Keys)>{Keys::name...});
  }
};

/// `switching` of element I at the state x of a model, with its reset.
template <class Model, std::size_t I, class Element>
struct element_switching : described<Element> {
  const Model* model;

  template <class T, class X>
  auto operator()(const T& t, const X& x) const {
    if constexpr (locks_coordinate<core>) {
      return mode_function(*model, t, own_part(x), place);
    } else {
      auto s = state_at(t, x);
      return on(s).switching(inputs{});
    }
  }
  /// The reset: switches the mode of the element.
  template <class T, class X>
  void switch_over(const T& t, X& x) const {
    if constexpr (locks_coordinate<core>) {
      auto own = own_part(x);
      switch_mode(*model, t, own, place);
      x.head(own.size()) = own;
    } else if constexpr (kept_count<core> > 0) {
      auto s = state_at(t, x);
      on(s).switch_over(inputs{});
      x.head(Eigen::fix<Model::state::RowsAtCompileTime>) = model->getJointStates(s);
    }
  }
  /// At the start of an integration: makes the mode of the element consistent. Returns whether it was inconsistent.
  template <class T, class X>
  bool mend(const T& t, X& x) const {
    if constexpr (locks_coordinate<core>) {
      auto own = own_part(x);
      if (!mend_at_start(*model, t, own, place)) return false;
      x.head(own.size()) = own;
      return true;
    } else if constexpr (kept_count<core> > 0) {
      auto after = own_part(x);
      switch_over(t, after);
      return mend_internals(after, x, after.size() - model->internals(), after.size());
    } else {
      return false;
    }
  }

 private:
  using wiring = typename Model::wiring;
  using core = typename Model::template core_type<I>;
  using inputs = std::make_index_sequence<input_count<core>>;
  static constexpr lock_place place = [] {
    lock_place p{};
    for (const auto& h : Model::locks())
      if (h.element == I) p = h;
    return p;
  }();

  /// The state without the states of a law.
  template <class X>
  static typename Model::state own_part(const X& x) {
    return x.head(Eigen::fix<Model::state::RowsAtCompileTime>);
  }
  template <class T, class X>
  auto state_at(const T& t, const X& x) const {
    auto s = make_state<T>(model->chain());
    model->setJointStates(t, own_part(x), s);
    model->doMotion(s);
    return s;
  }
  template <class State>
  auto on(State& s) const {
    return stored_element<core, State, by_index>{
        model->template core<I>(), s, {wiring::table.slot.data() + wiring::first[I]}};
  }

 public:
  /// Whether the law of the element can change.
  static constexpr bool changes =
      locks_coordinate<core> ||
      !typed_constant<decltype(std::declval<stored_element<core, chain_state<double, wiring>, by_index>>().switching(
          inputs{}))>;
};
/// The reset of an event of an element.
template <class Switching>
struct switch_element {
  Switching where;
  template <class T, class X>
  void operator()(const T& t, X& x) const {
    where.switch_over(t, x);
  }
};

/// The number of functions of a contact that pass through zero at events.
constexpr int parts_of_contact(const closure_rows& rows) { return rows.linear; }
/// For bridges: steps that bring less than this, s, are not needed by smooth motions of a chain of this length.
inline double patience_with_contacts(double length) { return 1e-3 * std::sqrt(length / 9.81); }
/// Several elements may switch at one time, and each again because of the others.
inline constexpr int repeats_of_elements = 100;
/// Gaps round by many eps of coordinates: less than the least flight (models/detail/contact_steps.hpp).
inline constexpr double rounding_of_gap = 3e-14;
/// The event of a function of a contact.
template <class Model, class Function>
auto contact_event(const Model& m, const Function& f) {
  return event(f, crossing::falling)
      .reset(switch_element<Function>{f})
      .reset_together(&m)
      .may_repeat(repeats_of_elements)
      .with_rounding(rounding_of_gap * m.contact_length())
      .unilateral();
}
/// At the start of an integration: makes the modes of contacts consistent. Returns whether they were not.
template <class Model, class T, class X>
bool mend_contacts(const Model& model, const T& t, X& x) {
  bool stepped = false;
  model.each_contact([&](int, int first) { stepped |= x[first] == stepped_mode; });
  if (stepped) return false;
  X after = x;
  bool wrong = !model.resolve_contacts(t, after).empty();
  const auto v = model.velocities_of(x);
  wrong |= (model.velocities_of(after) - v).cwiseAbs().maxCoeff() > 1e-9 * (1 + v.cwiseAbs().maxCoeff());
  if (wrong) x = after;
  return wrong;
}
/// Tells a model with contacts the tolerances of an integrator.
template <class Model, class Bounds>
void let_contacts_tolerate(const Model& m, const Bounds& bounds) {
  const double length = m.contact_length();
  double most = 0;
  for (Eigen::Index i = m.velocity_count(), n = 2 * i; i < n; ++i)
    most = (std::max)(most, static_cast<double>(bounds.absolute[i]) + static_cast<double>(bounds.relative[i]) * length);
  m.let_contacts_tolerate(most);
}
/// A function of a contact of a static chain, with its reset.
template <class Model>
struct contact_switching {
  const Model* model;
  int contact, part;
  std::string_view called;

  template <class T, class X>
  T operator()(const T& t, const X& x) const {
    return model->contact_margin(t, own_part(x), contact, part);
  }
  template <class T, class X>
  void switch_over(const T& t, X& x) const {
    auto own = own_part(x);
    (void)model->resolve_contacts(t, own, contact);
    x.head(own.size()) = own;
  }
  template <class T, class X>
  bool mend(const T& t, X& x) const {
    auto own = own_part(x);
    const bool was_wrong = mend_contacts(*model, t, own);
    x.head(own.size()) = own;
    return was_wrong;
  }
  std::string name() const { return std::string(called); }
  template <class Bounds>
  void tolerate(const Bounds& bounds) const {
    let_contacts_tolerate(*model, bounds);
  }
  /// For bridges (models/detail/contact_bridge.hpp): the time that many steps must bring, s; 0: none.
  double patience() const { return patience_with_contacts(model->contact_length()); }
  template <class T, class X>
  T bridge(const T& t, X& x, const T& t_end, int before) const {
    auto own = own_part(x);
    const T after = model->bridge_contacts(t, own, t_end, before);
    x.head(own.size()) = own;
    return after;
  }
  /// What the last event has changed.
  std::string_view what() const { return model->contact_change(); }

 private:
  template <class X>
  static typename Model::state own_part(const X& x) {
    return x.head(Eigen::fix<Model::state::RowsAtCompileTime>);
  }
};
template <class Core, class... Keys, class Model, class Events>
void add_contact_events(const element<Core, Keys...>*, const Model& m, Events& all) {
  if constexpr (is_contact<Core>) {
    constexpr std::array<std::string_view, sizeof...(Keys)> names{Keys::name...};
    using key = std::tuple_element_t<sizeof...(Keys) - 1, std::tuple<Keys...>>;
    constexpr int slot = Model::wiring::template find<key>();
    for (int part = 0; part < parts_of_contact(Core::rows); ++part) {
      const contact_switching<Model> f{&m, slot, part, names.back()};
      all.push_back(contact_event(m, f));
    }
  }
}
/// The events of the contacts of a static chain.
template <class... E, class Model>
auto contact_events_of(const Model& m) {
  if constexpr ((is_contact<typename E::core_type> || ...)) {
    using function = contact_switching<Model>;
    std::vector<decltype(event(std::declval<function>()).reset(switch_element<function>{}))> all;
    (add_contact_events(static_cast<const E*>(nullptr), m, all), ...);
    return std::make_tuple(std::move(all));
  } else {
    return std::tuple<>{};
  }
}

template <class Function, class Model>
auto event_where(const Model& m) {
  if constexpr (Function::changes) {
    const Function f{{}, &m};
    return std::make_tuple(event(f).reset(switch_element<Function>{f}).may_repeat(repeats_of_elements));
  } else {
    return std::tuple<>{};
  }
}
template <class... E, class Model, std::size_t... I>
auto element_events_of(const Model& m, std::index_sequence<I...>) {
  return std::apply([](const auto&... e) { return events(e...); },
                    std::tuple_cat(event_where<element_switching<Model, I, E>>(m)..., contact_events_of<E...>(m)));
}
}  // namespace detail

/// Events where the laws of the elements of a model change: a spring saturates, teeth of a gear touch. Each is located
/// to the tolerance, ends the step and restarts the integration with the new law; elements then switch their modes,
/// such as friction between sliding and sticking (models/modes.hpp):
///
///   solver.integrate(10.0, kte::element_events(model));
///   solver.integrate(10.0, kte::joined(kte::events(ground), kte::element_events(model)));
///
/// Rigid contacts have events too, named after the contact: impacts, and where they lift, stick and slide; `what` of an
/// occurrence says what all contacts do.
///
/// The events are in the order of the elements, with their names, those of contacts of static chains last. The model
/// must outlive them. An element defines its event by a function `switching` of its core, with the ports as arguments,
/// that passes through zero.
template <class Gravity, class... E, class S, class Output>
[[nodiscard]] auto element_events(const manipulator_dynamics_model<static_chain<Gravity, E...>, S, Output>& model) {
  return detail::element_events_of<E...>(model, std::index_sequence_for<E...>{});
}

namespace detail {
/// The function of an event of a model under a control law; it evaluates the law first.
template <class Controlled, class Function>
struct under_law : Function {
  Controlled* system;

  template <class T, class X>
  auto operator()(const T& t, const X& x) const {
    system->set_inputs(t, x);
    return Function::operator()(t, x);
  }
  template <class T, class X>
  void switch_over(const T& t, X& x) const {
    system->set_inputs(t, x);
    Function::switch_over(t, x);
  }
  template <class T, class X>
  bool mend(const T& t, X& x) const {
    system->set_inputs(t, x);
    return Function::mend(t, x);
  }
  /// With constant inputs and states of the law.
  template <class T, class X>
  T bridge(const T& t, X& x, const T& t_end, int before) const requires requires(const Function& f) {
    f.bridge(t, x, t_end, before);
  }
  {
    system->set_inputs(t, x);
    return Function::bridge(t, x, t_end, before);
  }
};
template <class Controlled, class Function, class Reset>
auto event_under_law(Controlled& c, const event<Function, Reset>& e) {
  const under_law<Controlled, Function> f{e.function, &c};
  return e.with_functions(f, switch_element<under_law<Controlled, Function>>{f});
}
template <class Controlled, class Function, class Reset>
auto event_under_law(Controlled& c, const std::vector<event<Function, Reset>>& some) {
  std::vector<decltype(event_under_law(c, some.front()))> all;
  for (const auto& e : some) all.push_back(event_under_law(c, e));
  return all;
}
}  // namespace detail

/// Events of the elements of a model under a control law, with the inputs of the law at every time and state. Model and
/// law must outlive the events.
template <class Model, class Law, class Rates, int N>
auto element_events(controlled<Model, Law, Rates, N>& c) {
  return std::apply([&c](const auto&... e) { return events(detail::event_under_law(c, e)...); },
                    element_events(c.model()).list);
}
/// `settled` (models/modes.hpp) with the inputs of the law at (t, x).
template <class Model, class Law, class Rates, int N, class T, class X>
X settled(controlled<Model, Law, Rates, N>& c, const T& t, X x) {
  c.set_inputs(t, x);
  const auto own = settled(c.model(), t, c.own_part(x));
  x.head(own.size()) = own;
  return x;
}

}  // namespace kte
