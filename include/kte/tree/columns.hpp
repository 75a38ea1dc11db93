#pragma once

#include <kte/tree/placement.hpp>
#include <kte/tree/simd.hpp>

#include <algorithm>
#include <vector>

/// Rows over all axes beyond a body, which are contiguous. They pass inward along the tree together, several axes per
/// SIMD register.
namespace kte::tree {

/// Rows over axes. Bodies are visited from the last to the first, so that the entries before those of a body are still
/// unused. Registers that end at the last axis of a body may therefore begin before its first, and load what was stored
/// last.
template <class S>
class axis_rows {
 public:
  void resize(std::size_t rows, std::size_t axes) {
    stride_ = axes + most_lanes;
    numbers_.resize(most_lanes + rows * stride_);
  }
  KTE_INLINE std::size_t stride() const { return stride_; }
  KTE_INLINE S* operator[](int row) { return numbers_.data() + most_lanes + static_cast<std::size_t>(row) * stride_; }
  KTE_INLINE const S* operator[](int row) const {
    return numbers_.data() + most_lanes + static_cast<std::size_t>(row) * stride_;
  }

 private:
  std::size_t stride_ = 0;
  std::vector<S> numbers_;
};

/// The wrenches of several axes.
template <class S>
struct simd_wrench {
  vec3<simd<S>> force, torque;

  KTE_INLINE void put(const simd_lane<S>& at, const dense_wrench<S>& w) {
    at.put(force.x, w.force.x), at.put(force.y, w.force.y), at.put(force.z, w.force.z);
    at.put(torque.x, w.torque.x), at.put(torque.y, w.torque.y), at.put(torque.z, w.torque.z);
  }
  /// The powers of the wrenches on the unit rate of a joint of one axis.
  template <class P>
  KTE_INLINE void power_on(const body_node<P>& r, simd<S>& power) const {
    power = torque.z;
    if (r.moves != joint::revolute) power = r.slides * force.z + r.turns * power;
  }
  /// `slides`: unless the axis only turns.
  KTE_INLINE void power_on(const world_axis<S>& s, simd<S>& power, bool slides = true) const {
    power = s.angular.x * torque.x + s.angular.y * torque.y + s.angular.z * torque.z;
    if (slides) power += s.linear.x * force.x + s.linear.y * force.y + s.linear.z * force.z;
  }
  /// Transforms to the axes and origin of the parent.
  template <class P>
  KTE_INLINE void go_in(const body_node<P>& r, const joint_transform<S>& at) {
    const placed transform{r, at};
    force = transform.out(force), torque = transform.out(torque);
    add_cross(torque, at.position, force);
  }
  /// Goes to the origin of the parent, from which `step` leads to this one.
  KTE_INLINE void go_back(const vec3<S>& step) { add_cross(torque, step, force); }
  KTE_INLINE void add(const simd_wrench& w) {
    force.x += w.force.x, force.y += w.force.y, force.z += w.force.z;
    torque.x += w.torque.x, torque.y += w.torque.y, torque.z += w.torque.z;
  }
  /// Subtracts e times a wrench, for each number e.
  KTE_INLINE void subtract(const dense_wrench<S>& w, const simd<S>& e) {
    force.x -= w.force.x * e, force.y -= w.force.y * e, force.z -= w.force.z * e;
    torque.x -= w.torque.x * e, torque.y -= w.torque.y * e, torque.z -= w.torque.z * e;
  }
};

/// Loads three rows as vectors.
template <class S>
KTE_INLINE void load_vectors(vec3<simd<S>>& x, const S* from, std::size_t row) {
  load<S>(x.x, from), load<S>(x.y, from + row), load<S>(x.z, from + 2 * row);
}
template <class S>
KTE_INLINE void store_vectors(const vec3<simd<S>>& x, S* to, std::size_t row) {
  store<S>(x.x, to), store<S>(x.y, to + row), store<S>(x.z, to + 2 * row);
}

/// A wrench for every axis, at the origin and in the axes of the body that it has reached.
template <class S>
class wrench_rows {
 public:
  void resize(std::size_t axes) {
    rows_.resize(6, axes);
    for (int c = 0; c < 6; ++c)
      std::fill_n(rows_[c] + axes, most_lanes, S(0));  // entries that registers read beyond the last axis
  }
  KTE_INLINE const S* component(int c) const { return rows_[c]; }
  KTE_INLINE void set(int k, const dense_wrench<S>& w) {
    S* const x = rows_[0] + k;
    const std::size_t row = rows_.stride();
    x[0] = w.force.x, x[row] = w.force.y, x[2 * row] = w.force.z;
    x[3 * row] = w.torque.x, x[4 * row] = w.torque.y, x[5 * row] = w.torque.z;
  }
  KTE_INLINE dense_wrench<S> get(int k) const {
    const S* const x = rows_[0] + k;
    const std::size_t row = rows_.stride();
    return {{x[0], x[row], x[2 * row]}, {x[3 * row], x[4 * row], x[5 * row]}};
  }
  KTE_INLINE void get_simd(int k, simd_wrench<S>& w) const {
    load_vectors(w.force, rows_[0] + k, rows_.stride()), load_vectors(w.torque, rows_[3] + k, rows_.stride());
  }
  KTE_INLINE void set_simd(int k, const simd_wrench<S>& w) {
    store_vectors(w.force, rows_[0] + k, rows_.stride()), store_vectors(w.torque, rows_[3] + k, rows_.stride());
  }
  /// Calls f(wrenches, first axis) for the axes from `first` up to `last`; f changes the wrenches. The last register
  /// ends at `last`.
  template <class F>
  KTE_INLINE void change(int first, int last, const F& f) {
    for_each_simd_to<S>(last, first, [&](int k) KTE_INLINE_LAMBDA { change_simd(k, f); });
  }
  /// `change` of the torques only.
  template <class F>
  KTE_INLINE void change_torques(int first, int last, const F& f) {
    const S* const forces = rows_[0];
    S* const torques = rows_[3];
    const std::size_t row = rows_.stride();
    for_each_simd_to<S>(last, first, [=, &f](int k) KTE_INLINE_LAMBDA {
      simd_wrench<S> w;
      load_vectors(w.force, forces + k, row), load_vectors(w.torque, torques + k, row);
      f(w, k);
      store_vectors(w.torque, torques + k, row);
    });
  }
  /// `change` with the first register beginning at `first`.
  template <class F>
  KTE_INLINE void change_from(int first, int last, const F& f) {
    for_each_simd<S>(first, last, [&](int k) KTE_INLINE_LAMBDA { change_simd(k, f); });
  }
  /// The powers of the wrenches from `first` up to `last` on the unit rate of axis a of a joint, as a row: this one, or
  /// `to`.
  template <class P>
  const S* powers_on(const body_node<P>& r, const joint_transform<S>& at, int a, int first, int last, S* to) const {
    if (r.moves == joint::several) return component(r.axis[static_cast<std::size_t>(a)]);
    if (r.moves == joint::revolute) return component(5);
    for_each_simd<S>(first, last, [&](int k) KTE_INLINE_LAMBDA {
      simd_wrench<S> w;
      get_simd(k, w);
      simd<S> along;
      if (r.moves == joint::varying) [[unlikely]]
        w.power_on(at.axis(a), along);
      else
        w.power_on(r, along);
      store<S>(along, to + k);
    });
    return to;
  }

 private:
  template <class F>
  KTE_INLINE void change_simd(int k, const F& f) {
    simd_wrench<S> w;
    get_simd(k, w);
    f(w, k);
    set_simd(k, w);
  }
  axis_rows<S> rows_;
};

}  // namespace kte::tree
