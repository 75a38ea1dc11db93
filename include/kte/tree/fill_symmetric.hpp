#pragma once

#include <kte/tree/columns.hpp>

namespace kte::tree {

/// Copies the lower triangle of an n x n matrix to the upper one, in blocks that remain in the cache.
template <class S>
[[gnu::noinline]] void mirror_lower_triangle(S* x, std::ptrdiff_t n) {
  constexpr std::ptrdiff_t block = 8;
  for (std::ptrdiff_t first = 0; first < n; first += block)
    for (std::ptrdiff_t row = first; row < n; row += block) {
      const std::ptrdiff_t end = (std::min)(row + block, n), last = (std::min)(first + block, n);
      for (std::ptrdiff_t j = first; j < last; ++j)
        for (std::ptrdiff_t i = (std::max)(row, j + 1); i < end; ++i) x[j + i * n] = x[i + j * n];
    }
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
      m.setZero(axes, axes);
    S* const x = m.data();
    constexpr int few_axes = 32;
    if (axes > few_axes) {  // columns far apart share lines of the cache
      for (const body_node<P>& r : f.nodes)
        for (int j = r.first; j < r.first + r.axes; ++j)
          std::copy(rows[j] + j, rows[j] + (all ? axes : r.last), x + (std::ptrdiff_t{j} * axes + j));
      mirror_lower_triangle(x, axes);
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

}  // namespace kte::tree
