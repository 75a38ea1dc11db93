#pragma once

#include <kte/dynamics/detail/stored_algorithms.hpp>
#include <kte/dynamics/detail/stored_state.hpp>

/// A static chain in the algorithms that are loops over elements: one function for each type of element core, however
/// many elements there are of it.
namespace kte::detail {

/// The elements, in the loops of stored_algorithms.hpp.
template <class Chain>
struct static_elements {
  const Chain& chain;

  template <class Step, class State>
  void forward(State& s) const {
    forward<Step>(s, std::make_index_sequence<Chain::size>{});
  }
  template <class Step, class State>
  void backward(State& s) const {
    backward<Step>(s, std::make_index_sequence<Chain::size>{});
  }
  template <class Step, class State>
  void down_from(int e, State& s) const {
    down_from<Step>(e, s, std::make_index_sequence<Chain::size>{});
  }
  static constexpr bool reads_positions() { return Chain::reads_positions; }

 private:
  using wiring = typename Chain::wiring;
  /// Out of line, so that code does not grow with the number of elements.
  template <class Step, class Core, class State>
  [[gnu::noinline]] static void perform_apart(const Core& core, State& s, const int* index, const place& at) {
    perform<Step>(core, s, index, at);
  }
  template <class Step, std::size_t I, class State>
  void one(State& s) const {
    if constexpr (concerns<Step::of, core_of<Chain, I>>)
      perform_apart<Step>(chain.template core<I>(), s,
                          wiring::table.slot.data() + static_cast<std::size_t>(wiring::first[I]),
                          static_plan<Chain>.places[I]);
  }
  template <class Step, class State, std::size_t... I>
  void forward(State& s, std::index_sequence<I...>) const {
    const int done[]{(one<Step, I>(s), 0)..., 0};
    (void)done;
  }
  template <class Step, class State, std::size_t... I>
  void backward(State& s, std::index_sequence<I...>) const {
    const int done[]{(one<Step, Chain::size - 1 - I>(s), 0)..., 0};
    (void)done;
  }
  template <class Step, class State, std::size_t... I>
  void down_from(int e, State& s, std::index_sequence<I...>) const {
    const auto if_next = [&]<std::size_t J>() {
      if (e != static_cast<int>(J)) return 0;
      one<Step, J>(s);
      e = static_plan<Chain>.places[J].below;
      return 0;
    };
    const int done[]{if_next.template operator()<Chain::size - 1 - I>()..., 0};
    (void)done;
  }
};

}  // namespace kte::detail
