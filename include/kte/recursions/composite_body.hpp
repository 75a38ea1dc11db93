#pragma once

#include <kte/engine/body.hpp>
#include <kte/frames/articulated.hpp>

/// Composite inertias: of a body and its subtree with locked joints (Featherstone 2008, section 6.2).
namespace kte::engine {

/// A composite inertia about the origin of the parent and in its axes.
template <body B, class I>
KTE_INLINE constexpr auto inertia_seen_by_parent(const B& b, const I& i) {
  const auto h = b.out(i.moment);
  const auto& p = b.position();
  return composite{i.mass, h + i.mass * p,
                   kte::detail::shifted(b.out(i.inertia), p, h + kte::detail::half(i.mass) * p)};
}
/// Steps of composite inertias: the inertia fixed to a body or frame; no change at the joint; to the parent.
struct fixed_inertia {
  template <class B, class Kept>
  KTE_INLINE constexpr auto operator()(const B& b, const Kept&) const {
    return fresh(b.composite());
  }
};
struct same_inertia {
  template <body B, class I, class Ends>
  KTE_INLINE constexpr auto operator()(const B&, const I& i, const Ends&) const {
    return fresh(i);
  }
};
struct inertia_to_parent {
  template <body B, class Kept, class I>
  KTE_INLINE constexpr auto operator()(const B& b, const Kept&, const I& i) const {
    return inertia_seen_by_parent(b, i);
  }
};
/// Inward: writes the composite inertias of all bodies to `kept`; with `Bases` also those of bases, which must contain
/// their own.
template <bool Bases, class Hand, class Driver, class Kept>
KTE_INLINE void composite_inertias(const Driver& d, const Kept& kept) {
  d.template inward<true, Hand, Bases>(kept, kept_constant<no_value>{}, fixed_inertia{}, same_inertia{},
                                       inertia_to_parent{});
}
/// The composite inertia of a frame's subtree, about its origin and in its axes. meet(body, inertia, place) is called
/// for each body on it with the inertia that the body carries, and returns it.
template <class Frame, class Driver, class Meet = same_inertia>
KTE_INLINE constexpr auto composite_inertia_of(const Driver& d, const Meet& meet = {}) {
  return d.template carried<Frame>(kept_constant<no_value>{}, fixed_inertia{}, meet, inertia_to_parent{});
}

/// Calls put(i, j, s_i^T f) for the axes i of a body and a wrench f of axis j; f is then passed to the parent.
template <class Put>
struct column_to_parent {
  const Put& put;
  int j;
  template <body_with_axes B, class W>
  KTE_INLINE constexpr auto operator()(const B& b, const W& w) const {
    each_power(b, w, [this, &b](int k, const auto& m) KTE_INLINE_LAMBDA { put(b.first() + k, j, m); });
    return pulled_back(b, w);
  }
};
/// The mass matrix (CRBA; Walker and Orin 1982; Featherstone 2008, section 6.2), while composite inertias I^c go
/// inward: the wrench of a unit acceleration of an axis j goes to the base, past axes i:
///
///   M_ij = s_i^T (I^c_j s_j)          (1)
///
/// A column consists of put.diagonal(j, M_jj), and put(i, j, M_ij) for each axis i on the path.
template <class Put>
struct mass_columns {
  const Put& put;
  template <body_with_axes B, class I, class Place>
  KTE_INLINE constexpr auto operator()(const B& b, const I& composite_inertia, const Place& place) const {
    columns<0>(b, composite_inertia, place);
    return fresh(composite_inertia);
  }

 private:
  template <int K, class B, class I, class Place>
  KTE_INLINE constexpr void columns(const B& b, const I& composite_inertia, const Place& place) const {
    if constexpr (K < B::axes) {
      const auto s = b.template axis<K>();
      const auto w = accelerating_wrench(composite_inertia, s.linear, s.angular);
      const int j = b.first() + K;
      put.diagonal(j, power(s, w));
      each_power<0, K>(b, w, [this, &b, j](int k, const auto& m) KTE_INLINE_LAMBDA { put(b.first() + k, j, m); });
      place.ancestors(pulled_back(b, w), column_to_parent<Put>{put, j});
      columns<K + 1>(b, composite_inertia, place);
    }
  }
};
template <class Driver, class Put>
KTE_INLINE constexpr void mass_matrix(const Driver& d, const Put& put) {
  d.template inward<false, no_value, false>(no_value{}, kept_constant<no_value>{}, fixed_inertia{},
                                            mass_columns<Put>{put}, inertia_to_parent{});
}

/// Momenta at unit rates of axes, the columns of the centroidal momentum matrix (Orin, Goswami, Lee, Autonomous Robots
/// 35, 2013, section 3): put(place, k, momentum) for each axis k of a body that carries I^c,
///
///   X I^c s_k          (2)
///
/// X transforms a momentum, as a wrench, by pose(place) of the body, whose position is from the reference point.
template <class Pose, class Put>
struct momenta_of_axes {
  Pose pose;
  Put put;
  template <body B, class I, class Place>
  KTE_INLINE constexpr auto operator()(const B& b, const I& inertia, const Place& place) const {
    each_axis(b, [&](const auto& k, const auto& s) KTE_INLINE_LAMBDA {
      put(place, k, transmit(pose(place), accelerating_wrench(inertia, s.linear, s.angular)));
    });
    return fresh(inertia);
  }
};
template <class Pose, class Put>
momenta_of_axes(Pose, Put) -> momenta_of_axes<Pose, Put>;

}  // namespace kte::engine
