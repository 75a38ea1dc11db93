#pragma once

#include <kte/tree/body_node.hpp>
#include <kte/tree/simd.hpp>

#include <algorithm>
#include <span>

/// Products with the inverse of a mass matrix that use the structure of the tree.
namespace kte::tree {

/// Rows 0 to n, known at compile time if n is a constant.
template <class Size>
struct all_rows {
  Size n;
  template <class F>
  KTE_INLINE void each(const F& f) const {
    for (int k = 0; k < n; ++k) f(k);
  }
};
struct some_rows {
  std::span<const int> rows;
  template <class F>
  KTE_INLINE void each(const F& f) const {
    for (const int k : rows) f(k);
  }
};
/// n x n matrices by columns, as in Eigen. Size: an int, or a constant.
template <class S, class Size = int, class Rows = some_rows>
struct solve_arguments {
  Size n;
  const S *inverse, *b, *c;
  S *x, *y;
  Rows rows;  ///< rows of b and c that may be non-zero
};
/// Rows from i on, and from `further` on, one register each, of columns j, j + 1 .. of X = -M^-1 B and Y = -M^-1 C.
template <int Columns, bool Two, class Simd, class S, class Size, class Rows>
KTE_INLINE void solve_block(const solve_arguments<S, Size, Rows>& s, int i, int further, int j) {
  Simd x[Columns]{}, y[Columns]{}, u[Columns]{}, v[Columns]{};
  const S *const b = s.b + j * s.n, *const c = s.c + j * s.n;
  s.rows.each([&](int k) KTE_INLINE_LAMBDA {
    const S* const column = s.inverse + k * s.n;
    Simd m, o{};
    load(m, column + i);
    if constexpr (Two) load(o, column + further);
    for (int a = 0; a < Columns; ++a) {
      const S &of_b = b[a * s.n + k], &of_c = c[a * s.n + k];
      x[a] -= of_b * m, y[a] -= of_c * m;
      if constexpr (Two) u[a] -= of_b * o, v[a] -= of_c * o;
    }
  });
  for (int a = 0; a < Columns; ++a) {
    S *const to_x = s.x + (j + a) * s.n, *const to_y = s.y + (j + a) * s.n;
    store(x[a], to_x + i), store(y[a], to_y + i);
    if constexpr (Two) store(u[a], to_x + further), store(v[a], to_y + further);
  }
}
template <int Columns, class S, class Size, class Rows>
void solve_together(const solve_arguments<S, Size, Rows>& s, int j) {
  constexpr int count = static_cast<int>(simd_of<S>::count);
  if (s.n < count) {
    for (int i = 0; i < s.n; ++i) solve_block<Columns, false, S>(s, i, i, j);
    return;
  }
  const int blocks = (s.n + count - 1) / count;  // the last block overlaps the previous one
  const auto begin = [&s](int block) KTE_INLINE_LAMBDA { return (std::min)(block * count, s.n - count); };
  for (int k = 0; k + 1 < blocks; k += 2) solve_block<Columns, true, simd<S>>(s, begin(k), begin(k + 1), j);
  if (blocks % 2 != 0) solve_block<Columns, false, simd<S>>(s, begin(blocks - 1), 0, j);
}

/// Columns from `first` to `end`.
template <class S, class Size, class Rows>
void solve_columns(const solve_arguments<S, Size, Rows>& s, int first, int end) {
  for (int j = first; j < end;) {
    switch (end - j) {
      case 1:
        solve_together<1>(s, j), j += 1;
        break;
      case 2:
      case 4:
        solve_together<2>(s, j), j += 2;
        break;
      default:
        solve_together<3>(s, j), j += 3;
    }
  }
}

/// X = -M^-1 B and Y = -M^-1 C for axes in order: a column of B and C has rows of ancestors and descendants of its
/// body. If `coupled`, columns are full.
template <class P, class S>
void solve_limbs(const body_tree<P>& f, bool coupled, std::vector<int>& rows, const S* inverse, const S* b, const S* c,
                 S* x, S* y) {
  const int n = static_cast<int>(f.axes());
  for (std::size_t i = 0; i < f.nodes.size();) {
    const body_node<P>& r = f.nodes[i];
    int end = r.first + r.axes;
    for (; ++i < f.nodes.size() && !f.nodes[i - 1].branches && f.nodes[i].parent == f.bases + static_cast<int>(i) - 1;)
      end += f.nodes[i].axes;
    rows.clear();
    for (int slot = r.parent; slot >= f.bases && !coupled;) {
      const body_node<P>& before = f.nodes[static_cast<std::size_t>(slot - f.bases)];
      for (int k = 0; k < before.axes; ++k) rows.push_back(before.first + k);
      slot = before.parent;
    }
    for (int k = coupled ? 0 : r.first; k < (coupled ? n : r.last); ++k) rows.push_back(k);
    solve_columns(solve_arguments<S>{n, inverse, b, c, x, y, {rows}}, r.first, end);
  }
}

}  // namespace kte::tree
