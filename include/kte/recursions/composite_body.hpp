#pragma once

#include <kte/engine/body.hpp>
#include <kte/math/rigid_body.hpp>

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

}  // namespace kte::engine
