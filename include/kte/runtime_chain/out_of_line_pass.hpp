#pragma once

#include <kte/contract/passes.hpp>
#include <kte/contract/thing.hpp>
#include <kte/math/out_of_line.hpp>

#include <bit>
#include <tuple>
#include <utility>

/// The passes of one element of a runtime chain in dual numbers, on copies of its connected items whose arithmetic is
/// not inlined (math/out_of_line.hpp). Cold, so that compilers keep them small: they are calls of that arithmetic.
namespace kte::detail {

template <class State>
using out_of_line_of = out_of_line<typename State::scalar>;

/// A copy of item i of kind K, without its load unless `kept`.
template <kind K, class State>
[[gnu::noinline]] thing_of<K, out_of_line_of<State>> out_of_line_copy(const State& s, int i, bool kept) {
  auto copy = std::bit_cast<thing_of<K, out_of_line_of<State>>>(s.template get<K>(i));
  if (kept) return copy;
  if constexpr (K == kind::gen) {
    copy.f = 0.0;
  } else if constexpr (!is_signal(K)) {
    clear_load(copy);
  }
  return copy;
}
/// Adds the load of a copy to the item.
template <kind K, class State>
[[gnu::noinline]] void add_out_of_line_load(State& s, int i, const thing_of<K, out_of_line_of<State>>& copy) {
  auto& x = s.template get<K>(i);
  const auto plain = std::bit_cast<thing_of<K, typename State::scalar>>(copy);
  if constexpr (K == kind::gen) {
    x.f = x.f + plain.f;
  } else if constexpr (K == kind::rotation_3D) {
    x.torque = x.torque + plain.torque;
  } else if constexpr (!is_signal(K)) {
    x.force = x.force + plain.force, x.torque = x.torque + plain.torque;
  }
}

template <class Core, class State, class Ports = std::make_index_sequence<port_count<Core>>>
class out_of_line_pass;
template <class Core, class State, std::size_t... P>
class out_of_line_pass<Core, State, std::index_sequence<P...>> {
  static constexpr bool has_output = Core::ports.back().how == access::out;
  static constexpr std::size_t last = sizeof...(P) - 1;

 public:
  using scalar = out_of_line_of<State>;

  [[gnu::cold]] out_of_line_pass(const Core& core, State& s, const int* index)
      : core_(core),
        state_(s),
        index_(index),
        things_{out_of_line_copy<Core::ports[P].what>(s, index[P], is_output(P))...} {}

  [[gnu::cold]] void motion() {
    pass().motion(inputs{});
    const int done[]{(Core::ports[P].declares() ? (give_back<P>(), 0) : 0)...};
    (void)done;
  }
  [[gnu::cold]] void force() {
    pass().force(inputs{});
    const int done[]{(
        is_output(P) ? 0 : (add_out_of_line_load<Core::ports[P].what>(state_, index_[P], std::get<P>(things_)), 0))...};
    (void)done;
  }
  /// The friction of a joint under a wrench.
  [[gnu::cold]] auto friction(const wrench<vec3<typename State::scalar>, vec3<typename State::scalar>>& end) {
    return scalar(pass().friction(std::bit_cast<wrench<vec3<scalar>, vec3<scalar>>>(end))).number;
  }
  /// The item connected to port i.
  template <kind K>
  auto& get(int i) {
    return *static_cast<thing_of<K, scalar>*>(at_[i]);
  }

 private:
  using inputs = std::make_index_sequence<input_count<Core>>;
  struct itself {
    template <std::size_t Port>
    static constexpr int at() {
      return static_cast<int>(Port);
    }
  };
  static constexpr bool is_output(std::size_t p) { return has_output && p == last; }
  auto pass() { return stored_element<Core, out_of_line_pass, itself>{core_, *this, {}}; }
  template <std::size_t Port>
  void give_back() {
    constexpr kind k = Core::ports[Port].what;
    state_.template get<k>(index_[Port]) = std::bit_cast<thing_of<k, typename State::scalar>>(std::get<Port>(things_));
  }

  const Core& core_;
  State& state_;
  const int* index_;
  std::tuple<thing_of<Core::ports[P].what, scalar>...> things_;
  void* at_[sizeof...(P)]{&std::get<P>(things_)...};
};

}  // namespace kte::detail
