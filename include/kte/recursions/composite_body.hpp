#pragma once

#include <kte/engine/body.hpp>
#include <kte/frames/articulated.hpp>

/// Composite inertias: of a body with all beyond it, as if their joints were locked (Featherstone 2008, section 6.2).
namespace kte::engine {

/// A composite inertia about the origin of the parent and in its axes.
template <body B, class I>
KTE_INLINE constexpr auto inertia_seen_by_parent(const B& b, const I& i) {
  const auto h = b.out(i.moment);
  const auto& p = b.position();
  return composite{i.mass, h + i.mass * p,
                   kte::detail::shifted(b.out(i.inertia), p, h + kte::detail::half(i.mass) * p)};
}
/// Inward: the composite inertias of all bodies, into `kept`; with `Bases` those of bases too, which must hold their
/// own.
template <bool Bases, class Hand, class Driver, class Kept>
KTE_INLINE void composite_inertias(const Driver& d, const Kept& kept) {
  d.template inward<true, Hand, Bases>(
      kept, kept_constant<nothing>{}, [](const auto& b, nothing) KTE_INLINE_LAMBDA { return fresh(b.composite()); },
      [](const body auto&, const auto& i, bool) KTE_INLINE_LAMBDA { return fresh(i); },
      [](const body auto& b, nothing, const auto& i) KTE_INLINE_LAMBDA { return inertia_seen_by_parent(b, i); });
}

/// The composite inertia of all that a frame carries, about its origin and in its axes; meet(body, inertia) is called
/// of each body on it with what the body carries.
template <class Frame, class Driver, class Meet>
KTE_INLINE constexpr auto composite_inertia_of(const Driver& d, const Meet& meet) {
  return d.template carried<Frame>(
      kept_constant<nothing>{}, [](const auto& b, nothing) KTE_INLINE_LAMBDA { return fresh(b.composite()); },
      [&](const body auto& b, const auto& i, bool) KTE_INLINE_LAMBDA {
        meet(b, i);
        return fresh(i);
      },
      [](const body auto& b, nothing, const auto& i) KTE_INLINE_LAMBDA { return inertia_seen_by_parent(b, i); });
}
template <class Frame, class Driver>
KTE_INLINE constexpr auto composite_inertia_of(const Driver& d) {
  return composite_inertia_of<Frame>(d, [](const body auto&, const auto&) KTE_INLINE_LAMBDA {});
}
/// The mass matrix (CRBA; Walker and Orin 1982; Featherstone 2008, section 6.2), while composite inertias I^c go
/// inward: the wrench of a unit acceleration of an axis j goes on to the base, past axes i:
///
///   M_ij = s_i^T (I^c_j s_j)          (1)
///
/// A column is diagonal(j, M_jj) and put(i, j, M_ij) of each axis i that is met.
template <int K = 0, class Driver, body_with_axes B, class I, class Diagonal, class Put>
KTE_INLINE constexpr void mass_columns(const Driver& d, const B& b, const I& composite_inertia,
                                       const Diagonal& diagonal, const Put& put) {
  if constexpr (K < B::axes) {
    const auto s = b.template axis<K>();
    const auto w = accelerating_wrench(composite_inertia, s.linear, s.angular);
    diagonal(b.first() + K, power(s, w));
    each_power<0, K>(b, w, [&](int r, const auto& m) KTE_INLINE_LAMBDA { put(b.first() + r, b.first() + K, m); });
    d.ancestors(b, pulled_back(b, w), [&](const auto& parent, const auto& f) KTE_INLINE_LAMBDA {
      each_power(parent, f, [&](int r, const auto& m) KTE_INLINE_LAMBDA { put(parent.first() + r, b.first() + K, m); });
      return pulled_back(parent, f);
    });
    mass_columns<K + 1>(d, b, composite_inertia, diagonal, put);
  }
}
template <class Driver, class Diagonal, class Put>
KTE_INLINE constexpr void mass_matrix(const Driver& d, const Diagonal& diagonal, const Put& put) {
  d.template inward<false, nothing, false>(
      nothing{}, kept_constant<nothing>{},
      [](const auto& b, nothing) KTE_INLINE_LAMBDA { return fresh(b.composite()); },
      [&](const body auto& b, const auto& i, bool) KTE_INLINE_LAMBDA {
        mass_columns(d, b, i, diagonal, put);
        return fresh(i);
      },
      [](const body auto& b, nothing, const auto& i) KTE_INLINE_LAMBDA { return inertia_seen_by_parent(b, i); });
}

}  // namespace kte::engine
