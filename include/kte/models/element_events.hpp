#pragma once

#include <kte/events/events.hpp>
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

/// `switching` of element I at the state x of a model.
template <class Model, std::size_t I, class Element>
struct element_switching : described<Element> {
  const Model* model;

  template <class T, class X>
  auto operator()(const T& t, const X& x) const {
    auto s = make_state<T>(model->chain());
    model->setJointStates(t, x.head(Eigen::fix<Model::state::RowsAtCompileTime>), s);  // without those of a law
    model->doMotion(s);
    return on(s).switching(inputs{});
  }

 private:
  using wiring = typename Model::wiring;
  using core = typename Model::template core_type<I>;
  using inputs = std::make_index_sequence<input_count<core>>;
  template <class State>
  auto on(State& s) const {
    return stored_element<core, State, by_index>{
        model->template core<I>(), s, {wiring::table.slot.data() + wiring::first[I]}};
  }

 public:
  /// Whether the law of the element ever changes.
  static constexpr bool changes =
      !typed_constant<decltype(std::declval<stored_element<core, chain_state<double, wiring>, by_index>>().switching(
          inputs{}))>;
};

template <class Function, class Model>
auto event_where(const Model& m) {
  if constexpr (Function::changes) {
    return std::make_tuple(event(Function{{}, &m}).restart());
  } else {
    return std::tuple<>{};
  }
}
template <class... E, class Model, std::size_t... I>
auto element_events_of(const Model& m, std::index_sequence<I...>) {
  return std::apply([](const auto&... e) { return events(e...); },
                    std::tuple_cat(event_where<element_switching<Model, I, E>>(m)...));
}
}  // namespace detail

/// Events where the laws of the elements of a model change: a spring that saturates, teeth that touch. Each is located
/// to the tolerance, ends the step there and starts anew, by the law that holds from then on:
///
///   solver.integrate(10.0, kte::element_events(model));
///   solver.integrate(10.0, kte::joined(kte::events(ground), kte::element_events(model)));
///
/// In the order of the elements, with their names. The model must outlive them. An element says where by a function
/// `switching` of its core, of what its ports are connected to, that goes through zero there.
template <class Gravity, class... E, class S, class Output>
auto element_events(const manipulator_dynamics_model<static_chain<Gravity, E...>, S, Output>& model) {
  return detail::element_events_of<E...>(model, std::index_sequence_for<E...>{});
}

}  // namespace kte
