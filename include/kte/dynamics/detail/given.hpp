#pragma once

#include <kte/dynamics/detail/local_pass.hpp>
#include <kte/dynamics/joint_vector.hpp>
#include <kte/math/sincos.hpp>

/// What comes from outside into a fused evaluation: see `local_pass`.
namespace kte::detail {

/// The angles among the degrees of freedom of a chain: of_angle[n] is the coordinate of angle n, of_coordinate its
/// inverse.
template <class Wiring>
struct angles {
  static constexpr std::size_t count = [] {
    std::size_t n = 0;
    for (int i = 0; i < Wiring::dofs; ++i) n += Wiring::angle(i);
    return n;
  }();
  static constexpr auto of_angle = [] {
    std::array<int, count + 1> index{};
    std::size_t n = 0;
    for (int i = 0; i < Wiring::dofs; ++i)
      if (Wiring::angle(i)) index[n++] = i;
    return index;
  }();
  static constexpr auto of_coordinate = [] {
    std::array<std::size_t, static_cast<std::size_t>(Wiring::dofs) + 1> index{};
    for (std::size_t n = 0; n < count; ++n) index[static_cast<std::size_t>(of_angle[n])] = n;
    return index;
  }();
};

// ---- numbers, one a degree of freedom: at<i>()

/// From something with operator[].
template <class S, class V>
struct each {
  const V& v;
  template <int I>
  KTE_INLINE S at() const {
    return S(v[static_cast<std::size_t>(I)]);
  }
};
/// The same typed constant, or `skip`, for all.
template <class T>
struct same {
  template <int I>
  KTE_INLINE static constexpr T at() {
    return {};
  }
};
/// A member of the coordinates of a state.
template <class State, auto Member>
struct of_state {
  const State& s;
  template <int I>
  KTE_INLINE auto at() const {
    return s.coordinate(I).*Member;
  }
};

/// Positions of the degrees of freedom, with the sines and cosines of all angles at once.
template <class S, class Wiring, class Q>
struct positions {
  Q q;
  sines<S, angles<Wiring>::count> angle;

  KTE_INLINE explicit positions(const Q& positions_in)
      : q(positions_in), angle(gather(q, std::make_index_sequence<angles<Wiring>::count>{})) {}

  /// Throws `bad_argument` unless all are finite numbers.
  KTE_INLINE void check() const { check(std::make_integer_sequence<int, Wiring::dofs>{}); }
  /// Coordinate I with the given rates.
  template <int I, class QD, class QDD>
  KTE_INLINE auto with(const QD& q_dot, const QDD& q_ddot) const {
    if constexpr (Wiring::angle(I)) {
      constexpr std::size_t n = angles<Wiring>::of_coordinate[I];
      return coordinate{q.template at<I>(), q_dot, q_ddot, angle.cos[n], angle.sin[n]};
    } else {
      return coordinate{q.template at<I>(), q_dot, q_ddot, skip{}, skip{}};
    }
  }

 private:
  template <int... I>
  KTE_INLINE void check(std::integer_sequence<int, I...>) const {
    const std::array<S, sizeof...(I) + 1> x{q.template at<I>()...};
    check_finite(x, sizeof...(I), "kte: a coordinate is no finite number");
  }
  template <std::size_t... N>
  KTE_INLINE static auto gather(const Q& q, std::index_sequence<N...>) {
    const std::array<S, sizeof...(N) + 1> x{q.template at<angles<Wiring>::of_angle[N]>()...};
    return sincos_all<S, sizeof...(N)>([&](std::size_t n) KTE_INLINE_LAMBDA { return x[n]; });
  }
};

// ---- frames that no element writes

/// All of them alike.
template <class M>
struct same_base {
  M m;
  template <kind, int>
  KTE_INLINE constexpr const M& at() const {
    return m;
  }
  template <int>
  KTE_INLINE static constexpr auto fixed() {
    return coordinate{zero, zero, zero, one, zero};
  }
  template <int>
  KTE_INLINE static constexpr zero_t input() {
    return {};
  }
};
template <class M>
same_base(M) -> same_base<M>;
/// As they are in a state; so are inputs and coordinates declared by base_gen.
template <class State>
struct base_of_state {
  const State& s;
  template <kind K, int I>
  KTE_INLINE constexpr decltype(auto) at() const {
    return spatial(s.template get<K>(I));
  }
  template <int I>
  KTE_INLINE constexpr auto fixed() const {
    const auto& c = s.coordinate(I);
    return with_angle(coordinate{c.q, c.q_dot, c.q_ddot, skip{}, skip{}});
  }
  template <int I>
  KTE_INLINE constexpr auto input() const {
    return s.template get<kind::input>(I);
  }
};

/// A base at rest under gravity. Positions and linear velocities are left out unless an element of the chain reads
/// them.
template <class Chain>
KTE_INLINE constexpr auto base_under_gravity(const Chain& c) {
  if constexpr (Chain::reads_positions) {
    return same_base{motion{zero3{}, no_rotation{}, zero3{}, zero3{}, -c.gravity(), zero3{}}};
  } else {
    return same_base{motion{skip{}, skip{}, skip{}, zero3{}, -c.gravity(), zero3{}}};
  }
}

/// All that comes from outside: positions, rates, bases.
template <class At, class QD, class QDD, class Base>
struct given {
  const At& positions;
  QD q_dot;
  QDD q_ddot;
  Base bases;

  template <int I>
  KTE_INLINE auto coordinate() const {
    return positions.template with<I>(q_dot.template at<I>(), q_ddot.template at<I>());
  }
  template <int I>
  KTE_INLINE constexpr auto fixed() const {
    return bases.template fixed<I>();
  }
  template <kind K, int I>
  KTE_INLINE constexpr decltype(auto) base() const {
    return bases.template at<K, I>();
  }
  template <int I>
  KTE_INLINE constexpr auto input() const {
    return bases.template input<I>();
  }
};
template <class At, class QD, class QDD, class Base>
given(const At&, QD, QDD, Base) -> given<At, QD, QDD, Base>;

}  // namespace kte::detail
