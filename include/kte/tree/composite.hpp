#pragma once

#include <kte/engine/looped.hpp>
#include <kte/recursions/composite_body.hpp>
#include <kte/recursions/world_placement.hpp>
#include <kte/tree/mass_memory.hpp>

namespace kte::tree {

/// Computes the axes and origins of all bodies in the world from those of the bases, and on request the axes of joints.
/// `Hand`: without skipped ones.
template <class Hand, class P, class S, class... Axes>
void place_bodies_in_world(const body_tree<P>& f, memory<P, S>& m, Axes*... axes) {
  const one_axis_bodies<P, S> bodies(f, m.joint_transforms);
  engine::world_placements<Hand>(engine::looped<one_axis_bodies<P, S>>{bodies}, m.world.data(), axes...);
}

/// Computes the inertia of each body with all bodies that it carries, at its origin and in its axes; with `Bases` also
/// those of the bases. `Hand`: a type without skipped parts, if there are any.
template <bool Bases, class Hand = void, class P, class S>
void carry_bodies(const body_tree<P>& f, memory<P, S>& m) {
  using hand = std::conditional_t<std::is_void_v<Hand>, dense_composite<S>, Hand>;
  if constexpr (Bases)
    for (std::size_t b = 0; b < f.base_weight.size(); ++b) engine::assign(m.carried[b], f.base_weight[b]);
  const one_axis_bodies<P, S> bodies(f, m.joint_transforms);
  engine::composite_inertias<Bases, hand>(engine::looped<one_axis_bodies<P, S>>{bodies}, m.carried.data());
}

/// The wrench that accelerates the bodies beyond axis k of a joint at its unit rate, in the axes of the body.
template <class P, class S>
KTE_INLINE dense_wrench<S> accelerating(const body_node<P>& r, const joint_transform<S>& at, int k,
                                        const dense_composite<S>& c) {
  return with_axis(r, at, k, [&c](const auto& s) KTE_INLINE_LAMBDA {
    const auto w = accelerating_wrench(c, s.linear, s.angular);
    return dense_wrench<S>{as<S>(w.force), as<S>(w.torque)};
  });
}

/// The composite-rigid-body algorithm (CRBA; Featherstone 2008, section 6.2). With F the wrench that accelerates the
/// bodies beyond axis k,
///
///   M_jk = s_j . F          for k and all axes j before it          (1)
///
/// The recursion is inward; the wrenches of all axes beyond a body pass on together. The result is in rows over axes,
/// from the diagonal to the last axis beyond it. Call `carry_bodies` first.
template <class P, class S>
void masses(const body_tree<P>& f, const memory<P, S>& m, wrench_rows<S>& w, axis_rows<S>& rows) {
  w.resize(f.axes()), rows.resize(f.axes(), f.axes());
  for (std::size_t i = f.nodes.size(); i-- > 0;) {
    const body_node<P>& r = f.nodes[i];
    const dense_composite<S>& carried = m.carried[static_cast<std::size_t>(f.bases) + i];
    const joint_transform<S>& at = m.joint_transforms[i];
    const bool on_base = r.parent < f.bases;
    if (!r.has_matrix()) {
      const dense_wrench<S> own = accelerating(r, at, 0, carried);
      S* const to = rows[r.first];
      w.change(r.first, r.last, [&](simd_wrench<S>& x, int k) KTE_INLINE_LAMBDA {
        if (k <= r.first) x.put(simd_lane<S>(r.first - k), own);
        simd<S> along;
        x.power_on(r, along);  // (1)
        store<S>(along, to + k);
        if (!on_base) x.go_in(r, at);
      });
      continue;
    }
    for (int k = r.first; k < r.first + r.axes; ++k) w.set(k, accelerating(r, at, k - r.first, carried));
    for (int j = r.first; j < r.first + r.axes; ++j)
      if (const S* const power = w.powers_on(r, at, j - r.first, j, r.last, rows[j]); power != rows[j])
        std::copy(power + j, power + r.last, rows[j] + j);
    if (!on_base) w.change(r.first, r.last, [&](simd_wrench<S>& x, int) KTE_INLINE_LAMBDA { x.go_in(r, at); });
  }
}
/// `masses` in world axes, in which a wrench passes inward by a cross product. Bodies must be placed there, too. From
/// some 30 axes on this is faster, for each axis pays for its placement (docs/decisions/24-engine.md).
template <class P, class S>
void masses_in_world(const body_tree<P>& f, const memory<P, S>& m, wrench_rows<S>& w, axis_rows<S>& rows) {
  w.resize(f.axes()), rows.resize(f.axes(), f.axes());
  for (std::size_t i = f.nodes.size(); i-- > 0;) {
    const body_node<P>& r = f.nodes[i];
    const world_place<S>& place = m.world[static_cast<std::size_t>(f.bases) + i];
    const vec3<S> step = r.parent < f.bases ? vec3<S>{} : place.step;
    const bool slides = r.moves != joint::revolute;
    for (int k = r.first; k < r.first + r.axes; ++k) {
      const dense_wrench<S> own =
          accelerating(r, m.joint_transforms[i], k - r.first, m.carried[static_cast<std::size_t>(f.bases) + i]);
      w.set(k, {place.rotation * own.force, place.rotation * own.torque});
    }
    for (int j = r.first; j < r.first + r.axes; ++j) {
      const world_axis<S> axis = m.axes[static_cast<std::size_t>(j)];
      const bool last = j + 1 == r.first + r.axes;
      S* const to = rows[j];
      w.change_torques(last ? r.first : j, r.last, [=](simd_wrench<S>& x, int k) KTE_INLINE_LAMBDA {
        simd<S> power;
        x.power_on(axis, power, slides);  // (1)
        store<S>(power, to + k);
        if (last) x.go_back(step);
      });
    }
  }
}

}  // namespace kte::tree
