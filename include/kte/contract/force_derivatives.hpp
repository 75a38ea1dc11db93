#pragma once

#include <kte/contract/coordinate_variation.hpp>
#include <kte/contract/passes.hpp>

/// Derivatives of the forces of one element that acts on coordinates only: springs, dampers, masses.
namespace kte::detail {

/// `index`: the items at its ports. State: that of a chain, with results in work.of_forces.
template <class Core, class State>
struct force_derivatives {
  using S = typename State::scalar;
  const Core& core;
  State& state;
  const int* index;

  /// Subtracts them from the results, because tau is the force that elements do not provide.
  void subtract() const {
    if constexpr (is_on_coordinates<Core> && Core::ports.back().how != access::out) by_ports(inputs{});
  }

 private:
  using inputs = std::make_index_sequence<input_count<Core>>;
  template <std::size_t P>
  static constexpr port at = Core::ports[P];

  template <std::size_t P>
  const auto& thing() const {
    return state.template get<at<P>.what>(index[P]);
  }
  /// The row among the degrees of freedom; -1: not a degree of freedom.
  template <std::size_t P>
  int row() const {
    if constexpr (at<P>.what == kind::gen) {
      const int row = state.tree().plan.row_of_gen[static_cast<std::size_t>(index[P])];
      return row < state.dofs() ? row : -1;
    } else {
      return -1;
    }
  }
  template <std::size_t... P>
  void by_ports([[maybe_unused]] std::index_sequence<P...> all) const {
    const int done[]{(row<P>() < 0 || is_again<P>() ? 0 : (by_port<P>(all), 0))..., 0};
    (void)done;
  }
  /// Whether two ports have one coordinate. (A function, because g++ warns of a comparison of an expression with
  /// itself.)
  bool are_one(std::size_t a, std::size_t b) const { return index[a] == index[b]; }
  /// Whether port P has the coordinate of an earlier port; `seen` then varies both together.
  template <std::size_t P>
  bool is_again() const {
    for (std::size_t before = 0; before < P; ++before)
      if (Core::ports[before].what == kind::gen && are_one(before, P)) return true;
    return false;
  }
  /// Derivatives by the coordinate at port L.
  template <std::size_t L, std::size_t... P>
  void by_port(std::index_sequence<P...>) const {
    if constexpr (at<L>.what == kind::gen) {
      const auto loads = core.doForce(seen<P, L>()...);
      const int done[]{(row<P>() < 0 ? 0 : (subtract<P, L>(loads), 0))...};
      (void)done;
    }
  }
  template <std::size_t P, std::size_t L>
  auto seen() const {
    if constexpr (at<P>.what == kind::gen) {
      return varied_coordinate<S>(thing<P>(), are_one(P, L));
    } else {
      return number_of_signal<at<P>.what>(thing<P>());
    }
  }
  template <std::size_t P, std::size_t L, class Loads>
  void subtract(const Loads& loads) const {
    if constexpr (at<P>.what == kind::gen) {
      auto& r = state.work.of_forces;
      subtract_variation<S>(nth<load_index<Core, P>>(loads), r.by_q, r.by_v, r.by_a, row<P>(), row<L>());
    }
  }
};

template <class Core, class State>
void subtract_force_derivatives(const Core& core, State& s, const int* index) {
  force_derivatives<Core, State>{core, s, index}.subtract();
}

}  // namespace kte::detail
