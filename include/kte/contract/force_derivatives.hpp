#pragma once

#include <kte/contract/coordinate_variation.hpp>
#include <kte/contract/passes.hpp>
#include <kte/detail/unroll.hpp>

/// Derivatives of the forces of one element that acts on coordinates only: springs, dampers, masses.
namespace kte::detail {

/// `Ports` describes the ports of the element:
///   item<P>()       the coordinate or signal at port P, in the form that kernels take
///   row<P>()        the row of the coordinate at port P among the degrees of freedom; -1: not a degree of freedom
///   are_one(a, b)   whether two ports have one coordinate
/// `Result` has by_q, by_v, by_a.
template <class S, class Core, class Ports, class Result>
struct force_derivatives {
  const Core& core;
  const Ports& ports;
  Result& result;

  /// Subtracts them from the results, because tau is the force that elements do not provide.
  KTE_INLINE void subtract() const {
    if constexpr (is_on_coordinates<Core> && Core::ports.back().how != access::out)
      unroll(inputs{}, [this]<std::size_t L>() KTE_INLINE_LAMBDA {
        if constexpr (is_number<L>)
          if (ports.template row<L>() >= 0 && !this->template is_again<L>()) this->template by_port<L>(inputs{});
      });
  }

 private:
  using inputs = std::make_index_sequence<input_count<Core>>;
  template <std::size_t P>
  static constexpr bool is_number = Core::ports[P].what == kind::gen;

  /// Whether port L has the coordinate of an earlier port; `seen` then varies both together.
  template <std::size_t L>
  KTE_INLINE bool is_again() const {
    for (std::size_t before = 0; before < L; ++before)
      if (Core::ports[before].what == kind::gen && ports.are_one(before, L)) return true;
    return false;
  }
  /// Derivatives by the coordinate at port L.
  template <std::size_t L, std::size_t... P>
  KTE_INLINE void by_port(std::index_sequence<P...> all) const {
    const auto loads = core.doForce(seen<P, L>()...);
    unroll(all, [&]<std::size_t Q>() KTE_INLINE_LAMBDA {
      if constexpr (is_number<Q>)
        if (ports.template row<Q>() >= 0)
          subtract_variation<S>(nth<load_index<Core, Q>>(loads), result.by_q, result.by_v, result.by_a,
                                ports.template row<Q>(), ports.template row<L>());
    });
  }
  template <std::size_t P, std::size_t L>
  KTE_INLINE auto seen() const {
    if constexpr (is_number<P>)
      return varied_coordinate<S>(ports.template item<P>(), ports.are_one(P, L));
    else
      return ports.template item<P>();
  }
};

/// The ports of an element in a state; `index`: the items at its ports.
template <class Core, class State>
struct ports_in_state {
  State& state;
  const int* index;

  template <std::size_t P>
  decltype(auto) item() const {
    constexpr kind k = Core::ports[P].what;
    if constexpr (k == kind::gen)
      return std::as_const(state.template get<k>(index[P]));
    else
      return number_of_signal<k>(state.template get<k>(index[P]));
  }
  template <std::size_t P>
  int row() const {
    const int row = state.tree().plan.row_of_gen[static_cast<std::size_t>(index[P])];
    return row < state.dofs() ? row : -1;
  }
  /// (g++ would warn of a comparison of an expression with itself, if it were not a function.)
  bool are_one(std::size_t a, std::size_t b) const { return index[a] == index[b]; }
};

/// Subtracts them from `of_forces` of the working memory of a state.
template <class Core, class State>
void subtract_force_derivatives(const Core& core, State& s, const int* index) {
  const ports_in_state<Core, State> ports{s, index};
  auto& r = s.work.of_forces;
  force_derivatives<typename State::scalar, Core, decltype(ports), std::remove_reference_t<decltype(r)>>{core, ports, r}
      .subtract();
}

}  // namespace kte::detail
