#pragma once

#include <kte/kernels/joint_vector.hpp>
#include <kte/math/select.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

namespace kte::detail {

/// Factorises a symmetric positive definite matrix in place, from its lower triangle:
///
///   M = L D L^T,   d_j = m_jj - sum_k l_jk^2 d_k,   l_ij = (m_ij - sum_k l_ik l_jk d_k) / d_j          (1)
///
/// Golub and Van Loan, Matrix Computations, 4.1.2. Eigen's LLT is not inlined and takes as long as everything else
/// (docs/decisions/05-forward-dynamics.md). Returns false if a pivot d_j vanishes relative to m_jj.
template <class Matrix>
KTE_INLINE bool factorise(Matrix& m) {
  using S = typename Matrix::Scalar;
  const Eigen::Index n = m.rows();
  const S smallest(std::numeric_limits<S>::epsilon());
  bool good = true;
  for (Eigen::Index j = 0; j < n; ++j) {
    const S scale = m(j, j);
    for (Eigen::Index i = j; i < n; ++i) {
      S sum = m(i, j);
      for (Eigen::Index k = 0; k < j; ++k) sum -= m(i, k) * m(k, j);  // above the diagonal: l_jk d_k
      m(i, j) = sum;
    }
    good &= all(m(j, j) > smallest * scale);
    const S inverse = S(1) / m(j, j);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      m(j, i) = m(i, j);
      m(i, j) *= inverse;
    }
  }
  return good;
}
/// Solves M x = b in place, with M factorised.
template <class Matrix, class Vector>
KTE_INLINE void substitute(const Matrix& m, Vector& b) {
  const Eigen::Index n = m.rows();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < i; ++k) b[i] -= m(i, k) * b[k];
  for (Eigen::Index i = n; i-- > 0;) {
    b[i] /= m(i, i);
    for (Eigen::Index k = i + 1; k < n; ++k) b[i] -= m(k, i) * b[k];
  }
}

/// Names the coordinate, if known.
[[noreturn, gnu::cold]] inline void raise_singular_mass_matrix(std::string_view coordinate = {}) {
  std::string text("kte: the mass matrix is singular: ");
  if (coordinate.empty())
    text.append("a coordinate");
  else
    text.append("'").append(coordinate).append("'");
  raise<singular_mass_matrix>(text.append(" moves no mass independently of the others"));
}
/// The first row with a vanishing pivot; m_jj is recomputed by (1).
template <class Matrix>
[[gnu::cold, gnu::noinline]] int first_vanishing(const Matrix& m) {
  using S = typename Matrix::Scalar;
  const auto n = static_cast<int>(m.rows());
  for (int j = 0; j < n; ++j) {
    S scale = m(j, j);
    for (int k = 0; k < j; ++k) scale += m(j, k) * m(k, j);
    if (!all(m(j, j) > S(4) * S(std::numeric_limits<S>::epsilon()) * scale)) return j;
  }
  return n - 1;
}
/// Factorizes a mass matrix. If a coordinate moves no mass, or only what others move too, calls `fail` with its row,
/// which throws `singular_mass_matrix`.
template <class Matrix, class Fail>
KTE_INLINE void factorise_mass(Matrix& m, const Fail& fail) {
  if (!factorise(m)) [[unlikely]]
    fail(first_vanishing(m));
}
/// M^-1; M is overwritten.
template <class Matrix, class Inverse, class Fail>
KTE_INLINE void invert_by_factors(Matrix& m, Inverse& inverse, const Fail& fail) {
  factorise_mass(m, fail);
  inverse.setIdentity();
  for (Eigen::Index j = 0; j < inverse.cols(); ++j) {
    auto column = inverse.col(j);
    substitute(m, column);
  }
}

/// Calls f<4>(i) for rows i, i + 4, ... of n, with the last block moved back to end at n; f<1>(i) for fewer than four
/// rows.
template <int N, class F>
KTE_INLINE void for_each_four(Eigen::Index n, const F& f) {
  if constexpr (N == Eigen::Dynamic || N >= 4) {
    if (n >= 4) {
      for (Eigen::Index i = 0; i < n; i += 4) f.template operator()<4>((std::min)(i, n - 4));
      return;
    }
  }
  if constexpr (N < 4) {  // Eigen::Dynamic is negative
    for (Eigen::Index i = 0; i < n; ++i) f.template operator()<1>(i);
  }
}
/// X = -M^-1 B, which allocates nothing.
template <class Matrix, class X>
KTE_INLINE void solve_by_inverse(const Matrix& inverse, const Matrix& b, X& x) {
  using S = typename Matrix::Scalar;
  const Eigen::Index n = inverse.rows();
  for_each_four<Matrix::RowsAtCompileTime>(n, [&]<int N>(Eigen::Index i) KTE_INLINE_LAMBDA {
    for_each_four<Matrix::RowsAtCompileTime>(n, [&]<int C>(Eigen::Index j) KTE_INLINE_LAMBDA {
      Eigen::Matrix<S, N, C> sum = Eigen::Matrix<S, N, C>::Zero();
      for (Eigen::Index k = 0; k < n; ++k) {
        const Eigen::Matrix<S, N, 1> m = inverse.col(k).template segment<N>(i);
        for (Eigen::Index c = 0; c < C; ++c) sum.col(c) -= b(k, j + c) * m;
      }
      x.template block<N, C>(i, j) = sum;
    });
  });
}

/// Solves M x = b in place for a mass matrix M; the lower triangle of M is overwritten. Throws what `factorise_mass`
/// throws.
template <class Matrix, class Vector, class Fail>
KTE_INLINE void solve_in_place(Matrix& m, Vector& b, const Fail& fail) {
  factorise_mass(m, fail);
  substitute(m, b);
}

/// Solves with some x known: their entries of b are x. Their rows and columns of M are overwritten.
template <class Matrix, class Vector, class Known, class Fail>
void solve_partly_known(Matrix& m, Vector& b, const Known& is_known, const Fail& fail) {
  using S = typename Matrix::Scalar;
  const Eigen::Index n = m.rows();
  const auto known = [&is_known](Eigen::Index i) { return is_known[static_cast<std::size_t>(i)]; };
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!known(k)) continue;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!known(i)) b[i] -= m(i, k) * b[k];
      m(i, k) = m(k, i) = S(0);
    }
    m(k, k) = S(1);
  }
  solve_in_place(m, b, fail);
}

}  // namespace kte::detail
