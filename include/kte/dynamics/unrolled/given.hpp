#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/arguments/diagnose.hpp>
#include <kte/dynamics/unrolled/passes.hpp>
#include <kte/kernels/joint_vector.hpp>
#include <kte/math/quaternion.hpp>
#include <kte/math/sincos.hpp>

/// External arguments of a fused evaluation: see `unrolled_passes`.
namespace kte::detail {

/// The positions in q of angles whose sine and cosine are needed, and of quaternions.
template <class Wiring>
struct turning {
  struct list {
    std::size_t count{};
    std::array<std::size_t, std::size_t{Wiring::nq} + 1> place{};  ///< index in q of angle or quaternion n
    std::array<std::size_t, std::size_t{Wiring::nq} + 1>
        number{};  ///< number of the angle or quaternion at index i, if any
    constexpr void add(int i) {
      number[static_cast<std::size_t>(i)] = count;
      place[count++] = static_cast<std::size_t>(i);
    }
  };
  static constexpr list angles = [] {
    list l;
    for (std::size_t i = 0; i < Wiring::freedoms; ++i) {
      const auto& f = Wiring::table.free[i];
      if (f.what == kind::gen && Wiring::angle(f.slot)) l.add(f.q);
      if (f.what == kind::pose_2D) l.add(f.q + 2);
    }
    return l;
  }();
  static constexpr list quaternions = [] {
    list l;
    for (std::size_t i = 0; i < Wiring::freedoms; ++i) {
      const auto& f = Wiring::table.free[i];
      if (f.what == kind::rotation_3D) l.add(f.q);
      if (f.what == kind::pose_3D) l.add(f.q + 3);
    }
    return l;
  }();
};

/// Three numbers as a vector.
template <int I, class V>
KTE_INLINE auto vector_at(const V& v) {
  return vec3{v.template at<I>(), v.template at<I + 1>(), v.template at<I + 2>()};
}

/// A configuration, with the sines and cosines of all angles at once, and the matrices of the quaternions.
template <class S, class Wiring, class Q>
struct configuration {
  using turns = turning<Wiring>;
  each<S, Q> q;
  sines<S, turns::angles.count> angle;
  std::array<mat3<vec3<S>>, turns::quaternions.count + 1> rotation;

  KTE_INLINE explicit configuration(const Q& numbers)
      : q{numbers}, angle(gather(q, std::make_index_sequence<turns::angles.count>{})) {
    unroll<turns::quaternions.count>([this]<std::size_t N>() KTE_INLINE_LAMBDA {
      rotation[N] = matrix_of_any_length(this->template quaternion<int{turns::quaternions.place[N]}>());
    });
  }

  /// Throws `bad_argument` unless all numbers are finite and quaternions are not 0.
  KTE_INLINE void check() const {
    check(std::make_integer_sequence<int, Wiring::nq>{});
    check_rotations(std::make_index_sequence<turns::quaternions.count>{});
  }
  /// Coordinate Slot of kind K with its rates.
  template <kind K, int Slot, class V, class A>
  KTE_INLINE auto with(const V& v, const A& a) const {
    constexpr freedom at = Wiring::template at<K, Slot>;
    if constexpr (K == kind::gen && Wiring::angle(Slot)) {
      constexpr std::size_t n = turns::angles.number[at.q];
      return coordinate{q.template at<at.q>(), v.template at<at.v>(), a.template at<at.v>(), angle.cos[n],
                        angle.sin[n]};
    } else if constexpr (K == kind::gen) {
      return coordinate{q.template at<at.q>(), v.template at<at.v>(), a.template at<at.v>(), skip{}, skip{}};
    } else if constexpr (K == kind::rotation_3D) {
      return motion{zero3{},           rotation[turns::quaternions.number[at.q]], zero3{}, vector_at<at.v>(v), zero3{},
                    vector_at<at.v>(a)};
    } else if constexpr (K == kind::pose_2D) {
      constexpr std::size_t n = turns::angles.number[at.q + 2];
      return motion{
          vec3{q.template at<at.q>(), q.template at<at.q + 1>(), zero}, rotation_2D{angle.cos[n], angle.sin[n]},
          vec3{v.template at<at.v>(), v.template at<at.v + 1>(), zero}, vec3{zero, zero, v.template at<at.v + 2>()},
          vec3{a.template at<at.v>(), a.template at<at.v + 1>(), zero}, vec3{zero, zero, a.template at<at.v + 2>()}};
    } else {
      return motion{vector_at<at.q>(q), rotation[turns::quaternions.number[at.q + 3]],
                    vector_at<at.v>(v), vector_at<at.v + 3>(v),
                    vector_at<at.v>(a), vector_at<at.v + 3>(a)};
    }
  }

 private:
  template <int... I>
  KTE_INLINE void check(std::integer_sequence<int, I...>) const {
    const std::array<S, sizeof...(I) + 1> x{q.template at<I>()...};
    check_result(x, sizeof...(I), [this]() KTE_INLINE_LAMBDA {
      diagnose<Wiring>("a coordinate", q, same<zero_t>{}, same<zero_t>{}, "a");
    });
  }
  template <std::size_t... N>
  KTE_INLINE void check_rotations(std::index_sequence<N...>) const {
    const std::array<S, sizeof...(N) + 1> x{rotation[N].x.x...};
    check_result(x, sizeof...(N), [this]() KTE_INLINE_LAMBDA {
      diagnose<Wiring>("a rotation", q, same<zero_t>{}, same<zero_t>{}, "a");
    });
  }
  template <std::size_t... N>
  KTE_INLINE static auto gather(const each<S, Q>& q, std::index_sequence<N...>) {
    const std::array<S, sizeof...(N) + 1> x{q.template at<int{turns::angles.place[N]}>()...};
    return sincos_all<S, sizeof...(N)>([&](std::size_t n) KTE_INLINE_LAMBDA { return x[n]; });
  }
  template <int I>
  KTE_INLINE auto quaternion() const {
    return unit_quaternion<S>{q.template at<I>(), q.template at<I + 1>(), q.template at<I + 2>(),
                              q.template at<I + 3>()};
  }
};

// ---- frames that no element writes

/// All bases have this motion.
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
  KTE_INLINE static constexpr void check() {}
  template <int>
  KTE_INLINE static constexpr zero_t input() {
    return {};
  }
  template <int>
  KTE_INLINE static constexpr zero3 vector() {
    return {};
  }
  template <int>
  KTE_INLINE static constexpr zero_t internal() {
    return {};
  }
};
template <class M>
same_base(M) -> same_base<M>;
/// Bases with the motion in a state; also its signals and coordinates declared by base_gen.
template <class State>
struct base_of_state {
  const State& s;
  /// Throws `bad_argument` unless the positions of prescribed coordinates are finite.
  KTE_INLINE void check() const {
    using wiring = typename State::wiring;
    for (int i = wiring::gen_dofs; i < wiring::count(kind::gen); ++i)
      if (wiring::writer(kind::gen, i) < 0)
        check_finite(&s.coordinate(i).q, 1, "kte: a prescribed coordinate is not finite");
  }
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
  template <int I>
  KTE_INLINE constexpr auto vector() const {
    return s.template get<kind::vector>(I);
  }
  template <int I>
  KTE_INLINE constexpr auto internal() const {
    return s.template get<kind::internal>(I).z;
  }
};

/// Only the positions of prescribed coordinates, and frames whose `Motion` is known.
template <class Base, class Motion>
struct only_positions : Base {
  Motion motion;
  template <kind, int>
  KTE_INLINE constexpr const Motion& at() const {
    return motion;
  }
  template <int I>
  KTE_INLINE constexpr auto fixed() const {
    const auto c = Base::template fixed<I>();
    return coordinate{c.q, zero, zero, c.cos, c.sin};
  }
};
template <class Base, class Motion>
only_positions(const Base&, Motion) -> only_positions<Base, Motion>;

/// A base at rest under gravity. Positions and linear velocities are omitted unless an element of the chain reads them.
template <class Chain, bool ReadsPositions = Chain::reads_positions>
KTE_INLINE constexpr auto base_under_gravity(const Chain& c) {
  if constexpr (ReadsPositions) {
    return same_base{motion{zero3{}, no_rotation{}, zero3{}, zero3{}, -c.gravity(), zero3{}}};
  } else {
    return same_base{motion{skip{}, skip{}, skip{}, zero3{}, -c.gravity(), zero3{}}};
  }
}

/// All external arguments: positions, rates, bases. With `RatesOnly`, elements see frames without accelerations:
/// accelerations from doMotion are then those due to velocities, and loads from doForce have no inertial forces of
/// accelerations.
template <class At, class V, class A, class Base, bool RatesOnly = false>
struct given : Base {
  static constexpr bool rates_only = RatesOnly;
  const At& at;
  V v;
  A a;

  KTE_INLINE constexpr given(const At& positions, V of_v, A of_a, Base bases)
      : Base(bases), at(positions), v(of_v), a(of_a) {}
  template <kind K, int I>
  KTE_INLINE auto coordinate() const {
    return at.template with<K, I>(v, a);
  }
  template <kind K, int I>
  KTE_INLINE constexpr decltype(auto) base() const {
    return Base::template at<K, I>();
  }
};
template <class At, class V, class A, class Base>
given(const At&, V, A, Base) -> given<At, V, A, Base>;

/// Throws `bad_argument`, naming the argument at fault, unless the results x[0] ... x[n-1] of `g` are finite.
template <class Wiring, class X, class Given>
KTE_INLINE void check_forces(const X& x, const Given& g) {
  check_result(x, std::size_t{Wiring::dofs}, [&]() KTE_INLINE_LAMBDA {
    if constexpr (Wiring::table.signals > 0) diagnose_signals<Wiring>("a force", g);
    diagnose<Wiring>("a force", g.at.q, g.v, g.a, "a");
  });
}
template <class Wiring, class X, class Given, class Tau>
KTE_INLINE void check_accelerations(const X& x, const Given& g, const Tau& tau) {
  using forces = each<typename Tau::Scalar, Tau>;
  check_result(x, std::size_t{Wiring::dofs}, [&]() KTE_INLINE_LAMBDA {
    if constexpr (Wiring::table.signals > 0) diagnose_signals<Wiring>("an acceleration", g);
    const Tau copy = tau;  // so that tau itself need not live in memory
    diagnose<Wiring>("an acceleration", g.at.q, g.v, forces{copy}, "tau");
  });
}

}  // namespace kte::detail
