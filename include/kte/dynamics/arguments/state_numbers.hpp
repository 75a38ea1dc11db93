#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/kernels/joint_vector.hpp>
#include <kte/static_chain/state.hpp>

#include <vector>

/// The numbers of coordinates in a state, static or runtime.
namespace kte {

namespace detail {
/// Calls visit(coordinate, freedom) for the degrees of freedom of a state.
template <class State, class Visit>
KTE_INLINE constexpr void for_each_freedom(State& s, const Visit& visit) {
  using wiring = typename std::remove_const_t<State>::wiring;
  unroll<wiring::freedoms>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    visit(s.template get<wiring::template free<I>.what>(wiring::template free<I>.slot), wiring::template free<I>);
  });
}
/// Whether a state may have items of kind K. For static chains this is known at compile time, and nothing is
/// instantiated for other kinds.
template <class State, kind K>
inline constexpr bool may_have = [] {
  if constexpr (requires { typename State::wiring; }) {
    return State::wiring::count(K) > 0;
  } else {
    return true;
  }
}();
/// Calls visit for coordinate `slot` of kind k, which is a spatial rotation or a pose.
template <class State, class Visit>
KTE_INLINE void with_turning_coordinate(State& s, kind k, int slot, const Visit& visit) {
  switch (k) {
    case kind::rotation_3D:
      if constexpr (may_have<State, kind::rotation_3D>) visit(s.template get<kind::rotation_3D>(slot));
      return;
    case kind::pose_2D:
      if constexpr (may_have<State, kind::pose_2D>) visit(s.template get<kind::pose_2D>(slot));
      return;
    default:
      if constexpr (may_have<State, kind::pose_3D>) visit(s.template get<kind::pose_3D>(slot));
  }
}
/// Calls visit for coordinate `slot` of kind k.
template <class State, class Visit>
KTE_INLINE void with_coordinate(State& s, kind k, int slot, const Visit& visit) {
  if (k != kind::gen)
    with_turning_coordinate(s, k, slot, visit);
  else if constexpr (may_have<State, kind::gen>)
    visit(s.template get<kind::gen>(slot));
}
/// Calls visit for frame `index` of kind k.
template <class State, class Visit>
KTE_INLINE void with_frame(State& s, kind k, int index, const Visit& visit) {
  if (k == kind::frame_2D) {
    if constexpr (may_have<State, kind::frame_2D>) visit(s.template get<kind::frame_2D>(index));
  } else {
    if constexpr (may_have<State, kind::frame_3D>) visit(s.template get<kind::frame_3D>(index));
  }
}
/// `for_each_freedom` as a loop, for states with a list `freedoms()`.
template <class State, class Visit>
void for_each_listed_freedom(State& s, const Visit& visit) {
  const auto all = s.freedoms();
  for (std::size_t i = 0; i < all.size();) {
    freedom at = all[i];
    if (at.what == kind::gen) [[likely]] {
      if constexpr (may_have<State, kind::gen>)
        for (const std::size_t end = i + static_cast<std::size_t>(at.in_row); i < end; ++i, ++at.slot, ++at.q, ++at.v)
          visit(s.template get<kind::gen>(at.slot), std::as_const(at));
    } else {
      with_turning_coordinate(s, at.what, at.slot, [&](auto& c) { visit(c, std::as_const(at)); });
      ++i;
    }
  }
}
/// Which vector a number belongs to: q, v, a, or forces.
enum class vector_of { q, v, a, f };
template <vector_of Which, class C, class Visit>
KTE_INLINE constexpr void visit_numbers(C& c, const Visit& visit) {
  if constexpr (Which == vector_of::q) {
    visit_q(c, visit);
  } else if constexpr (Which == vector_of::v) {
    visit_v(c, visit);
  } else if constexpr (Which == vector_of::a) {
    visit_a(c, visit);
  } else {
    visit_f(c, visit);
  }
}
template <vector_of Which>
KTE_INLINE constexpr std::size_t begin_of(const freedom& at) {
  return static_cast<std::size_t>(Which == vector_of::q ? at.q : at.v);
}
/// Stores numbers of x in a coordinate.
template <vector_of Which, class C, class X>
void put(C& c, const freedom& at, const X& x) {
  auto i = begin_of<Which>(at);
  visit_numbers<Which>(c,
                       [&](auto& number) { number = static_cast<std::remove_reference_t<decltype(number)>>(x[i++]); });
}
template <vector_of Which, int N, class S, class W>
KTE_INLINE auto read_numbers(const chain_state<S, W>& s) {
  joint_vector<S, N> x;
  for_each_freedom(s, [&x](const auto& c, const freedom& at) KTE_INLINE_LAMBDA {
    auto i = begin_of<Which>(at);
    visit_numbers<Which>(c, [&](const auto& number) KTE_INLINE_LAMBDA { x[Eigen::Index(i++)] = number; });
  });
  return x;
}
template <vector_of Which, class State, class X>
void read_listed_numbers(const State& s, X& x) {
  for_each_listed_freedom(s, [&x](const auto& c, const freedom& at) {
    auto i = begin_of<Which>(at);
    visit_numbers<Which>(c, [&](const auto& number) { x[Eigen::Index(i++)] = number; });
  });
}
template <vector_of Which, class State, class X>
KTE_INLINE constexpr void write_numbers(State& s, const X& x) {
  for_each_freedom(s, [&x](auto& c, const freedom& at) KTE_INLINE_LAMBDA {
    auto i = begin_of<Which>(at);
    visit_numbers<Which>(c, [&](auto& number) KTE_INLINE_LAMBDA {
      number = static_cast<std::remove_reference_t<decltype(number)>>(x[i++]);
    });
  });
}

/// Saves the accelerations, and on request the velocities, of a state with a list `freedoms()`, and sets them to zero;
/// restores them when destroyed.
template <class State>
class rates_aside {
  using S = typename State::scalar;

 public:
  rates_aside(State& s, bool velocities) : rates_aside(s, velocities, s.work.kept) {}
  /// In this memory: two numbers for each degree of freedom.
  rates_aside(State& s, bool velocities, std::vector<S>& kept) : state_(s), kept_(kept), velocities_(velocities) {
    each([](S& x, S& old) { old = x, x = S(0); });
  }
  ~rates_aside() {
    each([](S& x, const S& old) { x = old; });
  }
  rates_aside(const rates_aside&) = delete;
  rates_aside& operator=(const rates_aside&) = delete;

 private:
  template <class F>
  void each(const F& f) {
    for_each_listed_freedom(state_, [&](auto& c, const freedom& at) {
      auto i = static_cast<std::size_t>(at.v), j = i + static_cast<std::size_t>(state_.dofs());
      visit_a(c, [&](S& x) { f(x, kept_[i++]); });
      if (velocities_) visit_v(c, [&](S& x) { f(x, kept_[j++]); });
    });
  }
  State& state_;
  std::vector<S>& kept_;
  bool velocities_;
};
}  // namespace detail

}  // namespace kte
