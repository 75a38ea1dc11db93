#pragma once

#include <kte/tree/coriolis.hpp>

#include <algorithm>
#include <utility>

/// Matrices over coordinates from rows over axes.
namespace kte::tree {

/// Writes rows to a matrix of n rows by columns: several rows at a time, because entries of a row are far apart there.
template <class S>
class scattered_rows {
 public:
  scattered_rows(const axis_rows<S>& rows, S* x, std::ptrdiff_t n) : rows_(rows), x_(x), n_(n) {}
  /// The numbers of row j from `from`, which is j + 1 or less, up to `last`. Rows are given in order.
  void put(int j, int from, int last) {
    if (end_ - first_ == together || last != last_) finish(), first_ = j, last_ = last;
    from_[static_cast<std::size_t>(j - first_)] = from, end_ = j + 1;
  }
  /// Call this after the last row.
  void finish() {
    for (int j = first_; j < end_; ++j)
      for (int k = from_[static_cast<std::size_t>(j - first_)]; k < end_; ++k) *at(j, k) = rows_[j][k];
    if (end_ - first_ == together) return put_beyond();
    for (int j = first_; j < end_; ++j)
      for (int k = end_; k < last_; ++k) *at(j, k) = rows_[j][k];
  }

 private:
  static constexpr int lanes = static_cast<int>(simd_of<S>::count), together = lanes == 1 ? 8 : 2 * lanes;
  S* at(int row, int column) const { return x_ + (row + column * n_); }
  void put_beyond() {
    const S* const from = rows_[first_];
    const auto stride = static_cast<std::ptrdiff_t>(rows_.stride());
    for (int k = end_; k < last_; ++k)
      for (int j = 0; j < together; j += lanes) put_simd(from + (j * stride + k), stride, at(first_ + j, k));
  }
  KTE_INLINE static void put_simd(const S* from, std::ptrdiff_t stride, S* to) {
    if constexpr (lanes == 1)
      *to = *from;
    else
      put_lanes(from, stride, to, std::make_index_sequence<simd_of<S>::count>{});
  }
  template <std::size_t... I>
  KTE_INLINE static void put_lanes(const S* from, std::ptrdiff_t stride, S* to, std::index_sequence<I...>) {
    store<S>(simd<S>{from[static_cast<std::ptrdiff_t>(I) * stride]...}, to);
  }
  const axis_rows<S>& rows_;
  S* x_;
  std::ptrdiff_t n_;
  std::array<int, static_cast<std::size_t>(together)> from_{};
  int first_ = 0, end_ = 0, last_ = 0;
};

/// Makes an n x n matrix of axes; unless each axis moves all those after it, zero.
template <class P, class Matrix>
void make_square(const body_tree<P>& f, int n, Matrix& m) {
  if (std::all_of(f.nodes.begin(), f.nodes.end(), [n](const body_node<P>& r) { return r.last == n; }))
    m.resize(n, n);
  else
    m.setZero(n, n);
}
/// A symmetric matrix over coordinates from rows over axes, each from the diagonal on: those of the subtree of a joint,
/// or of all. Axes beyond `coordinates` are omitted.
template <class P, class S, class Matrix>
void fill_symmetric(const body_tree<P>& f, int coordinates, const axis_rows<S>& rows, bool all, Matrix& m) {
  const int axes = static_cast<int>(f.axes());
  if (f.in_order && axes == coordinates) [[likely]] {
    if (all)
      m.resize(axes, axes);
    else
      make_square(f, axes, m);
    S* const x = m.data();
    constexpr int few_axes = 32;
    if (axes > few_axes) {
      scattered_rows<S> to(rows, x, axes);
      for (const body_node<P>& r : f.nodes)
        for (int j = r.first; j < r.first + r.axes; ++j) {
          const int last = all ? axes : r.last;
          std::copy(rows[j] + j, rows[j] + last, x + (std::ptrdiff_t{j} * axes + j));
          to.put(j, j + 1, last);
        }
      to.finish();
      return;
    }
    for (const body_node<P>& r : f.nodes)
      for (int j = r.first; j < r.first + r.axes; ++j) {
        // Pointers only, because g++ makes several versions of a loop with strides, and selecting one takes longer than
        // running it.
        const S* from = rows[j] + j;
        S* down = x + (j * axes + j);
        const S* const end = x + (all ? axes : r.last) * axes;
        for (S* right = down; right < end; right += axes) *down++ = *right = *from++;
      }
    return;
  }
  m.setZero(coordinates, coordinates);
  for (const body_node<P>& r : f.nodes)
    for (int j = r.first; j < r.first + r.axes; ++j)
      for (int k = j; k < (all ? axes : r.last); ++k) {
        const int a = f.row[static_cast<std::size_t>(j)], b = f.row[static_cast<std::size_t>(k)];
        if (a >= coordinates || b >= coordinates) continue;
        const S& mass = rows[j][k];
        m(a, b) += mass;
        if (j != k) m(b, a) += mass;  // for shared coordinates both triangles meet on the diagonal
      }
}
/// The Coriolis matrix over coordinates. Axes beyond `coordinates` are omitted.
template <class P, class S, class Matrix>
void fill_coriolis(const body_tree<P>& f, int coordinates, const coriolis_memory<S>& from, Matrix& m) {
  const int axes = static_cast<int>(f.axes());
  if (f.in_order && axes == coordinates) [[likely]] {
    make_square(f, axes, m);
    scattered_rows<S> to(from.rows, m.data(), axes);
    for (const body_node<P>& r : f.nodes)
      for (int j = r.first; j < r.first + r.axes; ++j) {
        const S* const column = from.columns[j];
        std::copy(column + r.first + r.axes, column + r.last, m.data() + (std::ptrdiff_t{j} * axes + r.first + r.axes));
        to.put(j, r.first, r.last);
      }
    to.finish();
    return;
  }
  m.setZero(coordinates, coordinates);
  for_each_coriolis_term<false>(f, from, [&](int j, int k, const S& c_jk, const S&) {
    const int row = f.row[static_cast<std::size_t>(j)], column = f.row[static_cast<std::size_t>(k)];
    if (row < coordinates && column < coordinates) m(row, column) += c_jk;
  });
}

}  // namespace kte::tree
