#pragma once

#include <kte/detail/inline.hpp>
#include <kte/math/select.hpp>

#include <array>
#include <limits>
#include <utility>

namespace kte::detail {

/// The inertia D that a joint of N axes feels, symmetric and positive definite, as M = L D L^T of kernels/solve.hpp. Of
/// N = 3 or 6 rows, so no loops: all indices are constants, and the numbers stay in registers.
template <class S, int N>
class joint_factors {
  template <int M>
  using up_to = std::make_integer_sequence<int, M>;

 public:
  using numbers = std::array<S, std::size_t{N}>;

  /// Row I, column J <= I of the matrix, before `factorise`.
  template <int I, int J>
  KTE_INLINE constexpr S& at() {
    return m_[I][J];
  }
  /// Whether no pivot vanishes against its place on the diagonal.
  KTE_INLINE constexpr bool factorise() { return factorise(up_to<N>{}); }
  template <int J>
  KTE_INLINE constexpr const S& pivot() const {
    return m_[J][J];
  }
  /// D^-1 b
  KTE_INLINE constexpr numbers solved(numbers b) const { return solved(b, up_to<N>{}); }
  template <int K>
  KTE_INLINE constexpr numbers inverse_column() const {
    numbers unit{};
    unit[K] = S(1);
    return solved(unit);
  }

 private:
  template <int... J>
  KTE_INLINE constexpr bool factorise(std::integer_sequence<int, J...>) {
    bool good = true;
    const int done[]{(good = column<J>(up_to<N - 1 - J>{}) && good, 0)...};
    (void)done;
    return good;
  }
  template <int J, int... I>
  KTE_INLINE constexpr bool column(std::integer_sequence<int, I...>) {
    const S scale = m_[J][J];
    m_[J][J] = reduced<J, J>(up_to<J>{});
    inverse_[J] = S(1) / m_[J][J];
    const int done[]{(m_[J][J + 1 + I] = reduced<J + 1 + I, J>(up_to<J>{}),  // above the diagonal: l_ij d_j
                      m_[J + 1 + I][J] = m_[J][J + 1 + I] * inverse_[J], 0)...,
                     0};
    (void)done;
    return all(m_[J][J] > S(std::numeric_limits<S>::epsilon()) * scale);
  }
  template <int I, int J, int... K>
  KTE_INLINE constexpr S reduced(std::integer_sequence<int, K...>) const {
    return (m_[I][J] - ... - (m_[I][K] * m_[K][J]));
  }
  template <int... I>
  KTE_INLINE constexpr numbers solved(numbers b, std::integer_sequence<int, I...>) const {
    const int down[]{(b[I] = before<I>(b, up_to<I>{}), 0)...};
    const int up[]{(b[N - 1 - I] = behind<N - 1 - I>(S(b[N - 1 - I] * inverse_[N - 1 - I]), b, up_to<I>{}), 0)...};
    (void)down, (void)up;
    return b;
  }
  template <int I, int... K>
  KTE_INLINE constexpr S before(const numbers& b, std::integer_sequence<int, K...>) const {
    return (b[I] - ... - (m_[I][K] * b[K]));
  }
  template <int I, int... K>
  KTE_INLINE constexpr S behind(const S& x, const numbers& b, std::integer_sequence<int, K...>) const {
    return (x - ... - (m_[I + 1 + K][I] * b[I + 1 + K]));
  }

  S m_[N][N];
  S inverse_[N];  ///< of the pivots
};

}  // namespace kte::detail
