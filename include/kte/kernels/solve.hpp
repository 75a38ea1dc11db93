#pragma once

#include <kte/kernels/joint_vector.hpp>
#include <kte/math/select.hpp>

#include <limits>

namespace kte::detail {

/// Factorises a symmetric positive definite matrix in place, from its lower triangle:
///
///   M = L D L^T,   d_j = m_jj - sum_k l_jk^2 d_k,   l_ij = (m_ij - sum_k l_ik l_jk d_k) / d_j          (1)
///
/// Golub and Van Loan, Matrix Computations, 4.1.2. Eigen's LLT is a call of its own and takes as long as all the rest
/// (docs/decisions/05-forward-dynamics.md). Returns whether no pivot d_j vanishes against m_jj.
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
/// Solves M x = b in place, with M factorised. at(i) is number i of b, or row i of several.
template <class Matrix, class At>
KTE_INLINE void substitute_each(const Matrix& m, const At& at) {
  const Eigen::Index n = m.rows();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < i; ++k) at(i) -= m(i, k) * at(k);
  for (Eigen::Index i = n; i-- > 0;) {
    at(i) /= m(i, i);
    for (Eigen::Index k = i + 1; k < n; ++k) at(i) -= m(k, i) * at(k);
  }
}
template <class Matrix, class Vector>
KTE_INLINE void substitute(const Matrix& m, Vector& b) {
  substitute_each(
      m, [&b](Eigen::Index i) KTE_INLINE_LAMBDA -> auto& { return b[i]; });
}
template <class Matrix, class Rows>
KTE_INLINE void substitute_rows(const Matrix& m, Rows& b) {
  substitute_each(m, [&b](Eigen::Index i) KTE_INLINE_LAMBDA { return b.row(i); });
}

[[noreturn]] inline void raise_singular_mass_matrix() {
  raise<singular_mass_matrix>("kte: the mass matrix is singular: a coordinate moves no mass of its own");
}
/// Factorises a mass matrix. Throws `singular_mass_matrix` where a coordinate moves no mass, or only what others move
/// too.
template <class Matrix>
KTE_INLINE void factorise_mass(Matrix& m) {
  if (!factorise(m)) [[unlikely]]
    raise_singular_mass_matrix();
}
/// M^-1; M is used up.
template <class Matrix, class Inverse>
KTE_INLINE void invert_by_factors(Matrix& m, Inverse& inverse) {
  factorise_mass(m);
  inverse.setIdentity();
  for (Eigen::Index j = 0; j < inverse.cols(); ++j) {
    auto column = inverse.col(j);
    substitute(m, column);
  }
}

/// Solves M x = b in place for a mass matrix M, of which the lower triangle is used up. Throws as
/// `factorise_mass`, and `bad_argument` for NaN.
template <class Matrix, class Vector>
KTE_INLINE void solve_in_place(Matrix& m, Vector& b) {
  factorise_mass(m);
  substitute(m, b);
  check_finite(b, static_cast<std::size_t>(m.rows()), "kte: an acceleration is no finite number: an argument is none");
}

}  // namespace kte::detail
