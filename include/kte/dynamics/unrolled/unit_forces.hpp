#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/unrolled/tree.hpp>
#include <kte/frames/motion.hpp>
#include <kte/kernels/joint_vector.hpp>
#include <kte/tree/simd.hpp>

#include <algorithm>

/// Unit forces on the axes of a tree, which go to the base side by side in the lanes of a register.
namespace kte::detail {

/// Whether a wrench consists of numbers S and typed constants.
template <class S, class W>
inline constexpr bool is_wrench_of = false;
template <class S, class... F, class... T>
inline constexpr bool is_wrench_of<S, wrench<vec3<F...>, vec3<T...>>> =
    ((typed_constant<F> || std::is_same_v<F, S>)&&...) && ((typed_constant<T> || std::is_same_v<T, S>)&&...);

/// At most `Width` axes on one path to the base, of a tree with N degrees of freedom.
template <std::size_t Width, std::size_t N>
struct force_group {
  int tip = 0;  ///< the element farthest from the base
  std::size_t count = 0, length = 0;
  std::array<int, Width> row{};
  std::array<int, N> way{};  ///< all rows from the base to the tip
};

/// The axes of a tree in groups.
template <std::size_t Width, std::size_t N>
struct unit_forces {
  static constexpr std::size_t width = Width;
  std::size_t groups = 0;
  std::array<force_group<Width, N>, N> group{};

  /// The number of rows that the paths of two groups share, from the base on.
  constexpr std::size_t shared(std::size_t g, std::size_t h) const {
    const auto &a = group[g], &b = group[h];
    std::size_t n = 0;
    while (n < a.length && n < b.length && a.way[n] == b.way[n]) ++n;
    return n;
  }
  /// The forces of group G on the axes in rows from `first` on.
  template <class Simd, class S, std::size_t G, int Axes>
  KTE_INLINE constexpr std::array<Simd, std::size_t{Axes}> units(int first) const {
    std::array<Simd, std::size_t{Axes}> force{};
    for (std::size_t k = 0; k < group[G].count; ++k)
      if (const int n = group[G].row[k] - first; n >= 0 && n < Axes) {
        if constexpr (Width == 1)
          force[static_cast<std::size_t>(n)] = S(1);
        else
          force[static_cast<std::size_t>(n)][k] = S(1);
      }
    return force;
  }
};

/// Forms groups from the tips inward: a group takes the remaining axes on its path to the base. Elements come after
/// their parents; the last entry of `places` is empty.
template <std::size_t Width, std::size_t N, std::size_t E>
constexpr unit_forces<Width, N> side_by_side(const std::array<joint_place, E>& places) {
  unit_forces<Width, N> f;
  std::array<bool, N> taken{};
  const auto is_done = [&](const joint_place& p) {
    for (int row = p.row; row < p.row + p.axes; ++row)
      if (!taken[static_cast<std::size_t>(row)]) return false;
    return true;
  };
  const auto start = [&](force_group<Width, N>& g, std::size_t tip) {
    g.tip = static_cast<int>(tip);
    for (int at = g.tip; at >= 0; at = places[static_cast<std::size_t>(at)].below) {
      const joint_place& p = places[static_cast<std::size_t>(at)];
      for (int row = p.row + p.axes; row-- > p.row;) {
        g.way[g.length++] = row;
        if (g.count == Width || taken[static_cast<std::size_t>(row)]) continue;
        taken[static_cast<std::size_t>(row)] = true;
        g.row[g.count++] = row;
      }
    }
    std::reverse(g.way.begin(), g.way.begin() + static_cast<std::ptrdiff_t>(g.length));
  };
  for (std::size_t e = E; e-- > 0;)
    while (!is_done(places[e])) start(f.group[f.groups++], e);
  return f;
}

/// The terms (1) of recursions/inverse_mass.hpp between the axes of groups G and H of `Forces`, from e and D^-1 e. Row
/// i has one register of columns per group.
template <const auto& Forces, std::size_t G, std::size_t H, class Rows, class Matrix>
KTE_INLINE void sum_answers_between(const Rows& left, const Rows& rate, Matrix& inverse) {
  using S = typename Matrix::Scalar;
  constexpr std::size_t width = Forces.width;
  constexpr auto &g = Forces.group[G], &h = Forces.group[H];
  using simd = std::conditional_t<width == 1, S, tree::simd<S>>;
  constexpr std::size_t shared = Forces.shared(G, H);
  std::array<simd, g.count> sum{};
  for (std::size_t i = 0; i < shared; ++i) {
    const auto row = static_cast<std::size_t>(g.way[i]);
    simd e;
    tree::load<S>(e, left[row].data() + width * H);
    for (std::size_t k = 0; k < g.count; ++k) sum[k] += rate[row][width * G + k] * e;
  }
  unroll<int{g.count}>([&]<int K>() KTE_INLINE_LAMBDA {
    std::array<S, width> numbers;
    tree::store<S>(sum[K], numbers.data());
    constexpr std::size_t first = G == H ? K : 0;
    unroll<int{h.count - first}>([&]<int L>() KTE_INLINE_LAMBDA {
      inverse(h.row[first + L], g.row[K]) = inverse(g.row[K], h.row[first + L]) = numbers[first + L];
    });
  });
}
template <const auto& Forces, class Rows, class Matrix>
KTE_INLINE void sum_answers(const Rows& left, const Rows& rate, Matrix& inverse) {
  unroll<int{Forces.groups}>([&]<int G>() KTE_INLINE_LAMBDA {
    unroll<int{Forces.groups} - G>(
        [&]<int H>() KTE_INLINE_LAMBDA { sum_answers_between<Forces, G, G + H>(left, rate, inverse); });
  });
}

}  // namespace kte::detail
