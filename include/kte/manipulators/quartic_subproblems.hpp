#pragma once

#include <kte/manipulators/detail/angle_pairs.hpp>
#include <kte/manipulators/detail/three_axes_loop.hpp>
#include <kte/manipulators/detail/two_harmonics.hpp>
#include <kte/manipulators/two_links.hpp>

/// The subproblems of two and three angles that lead to equations of degree four (Elias and Wen, IK-Geo, 2025).
namespace kte {

/// The coefficients of n.R(k, t) p = a + b cos t + c sin t: `constant`, `cos`, `sin`.
template <class S>
struct linear_part {
  S constant, cos, sin;
};
/// The coefficients for a unit axis k, a vector p and a direction n.
template <class S, class N, class K>
[[nodiscard]] constexpr linear_part<S> linear_part_of(const N& normal, const K& axis, const vec3<S>& p) {
  const vec3<S> n = as<S>(normal), k = as<S>(axis);
  const S along = dot(n, k) * dot(k, p);
  return {along, dot(n, p) - along, dot(n, cross(k, p))};
}

/// Solves A x1 + B x2 = e with x_i = (cos t_i, sin t_i); A, B by rows. Let A be the matrix farther from singular
/// (otherwise the two are exchanged). Then x1 = g + G x2, and |x1| = 1 is an equation
///
///   al cos 2t + be sin 2t + ga cos t + de sin t + ep = 0          (1)
///
/// in t = t2. Roots that coincide to rounding are included. Newton's steps on both equations follow, as long as they
/// reduce the residuals, which near a double root they may not. (They are also taken within rounding, for derivatives.)
/// `slot` identifies a pair: 0, 2 and 1, 3.
template <class S>
[[nodiscard]] angle_pairs<S> subproblem6(const std::array<std::array<S, 2>, 2>& A,
                                         const std::array<std::array<S, 2>, 2>& B, const std::array<S, 2>& e) {
  using std::sqrt;
  using matrix = std::array<std::array<double, 2>, 2>;
  const auto number = [](const auto& m) {
    return matrix{{{detail::double_of(m[0][0]), detail::double_of(m[0][1])},
                   {detail::double_of(m[1][0]), detail::double_of(m[1][1])}}};
  };
  const auto det = [](const auto& m) { return m[0][0] * m[1][1] - m[0][1] * m[1][0]; };
  matrix a = number(A), b = number(B);
  const bool exchanged = std::abs(det(b)) > std::abs(det(a));
  if (exchanged) std::swap(a, b);
  const double d = det(a);
  angle_pairs<S> out;
  if (!(std::abs(d) > 0)) return out;
  const double e0 = detail::double_of(e[0]), e1 = detail::double_of(e[1]);
  const auto solve = [&](double x, double y) {
    return std::array{(a[1][1] * x - a[0][1] * y) / d, (a[0][0] * y - a[1][0] * x) / d};
  };
  const auto g = solve(e0, e1), G1 = solve(-b[0][0], -b[1][0]), G2 = solve(-b[0][1], -b[1][1]);
  const auto times = [](const auto& x, const auto& y) { return x[0] * y[0] + x[1] * y[1]; };
  const double P = times(G1, G1), Q = times(G2, G2), gg = times(g, g);
  const detail::two_harmonics f{(P - Q) / 2, times(G1, G2), 2 * times(g, G1), 2 * times(g, G2), gg + (P + Q) / 2 - 1};
  const double size = std::abs(f.al) + std::abs(f.be) + std::abs(f.ga) + std::abs(f.de) + gg + (P + Q) / 2 + 1;

  S noise(0);
  for (const auto& m : {A, B})
    for (const auto& row : m)
      for (const S& x : row) noise += S(4 * std::numeric_limits<S>::epsilon()) * (x < S(0) ? S(-x) : x);
  for (const double t : f.zeros(1e-11 * size)) {
    const double c = std::cos(t), s = std::sin(t);
    const auto other = direction(g[0] + G1[0] * c + G2[0] * s, g[1] + G1[1] * c + G2[1] * s);
    S t1 = exchanged ? S(t) : S(other.value()), t2 = exchanged ? S(other.value()) : S(t);
    auto x1 = angle_of(t1), x2 = angle_of(t2);
    const auto missed = [&](const solved_angle<S>& y1, const solved_angle<S>& y2) {
      const auto row = [&](std::size_t i) -> S {
        return A[i][0] * y1.cos + A[i][1] * y1.sin + B[i][0] * y2.cos + B[i][1] * y2.sin - e[i];
      };
      return std::array<S, 2>{row(0), row(1)};
    };
    const auto slope = [](const auto& row, const solved_angle<S>& x) -> S { return row[1] * x.cos - row[0] * x.sin; };
    auto miss = missed(x1, x2);
    bool negative = false;
    for (int k = 0; k < 3; ++k) {
      const auto& [r0, r1] = miss;
      const S j00 = slope(A[0], x1), j01 = slope(B[0], x2), j10 = slope(A[1], x1), j11 = slope(B[1], x2);
      const S j = j00 * j11 - j01 * j10;
      negative = j < S(0);
      const S d1 = (j11 * r0 - j01 * r1) / j, d2 = (j00 * r1 - j10 * r0) / j;
      const S s1 = t1 - d1, s2 = t2 - d2;
      const auto y1 = angle_of(s1), y2 = angle_of(s2);
      const auto left = missed(y1, y2);
      const S now = r0 * r0 + r1 * r1, then = left[0] * left[0] + left[1] * left[1];
      if (std::is_floating_point_v<S> ? !(then < now) : !(then < now) && !(then <= noise * noise)) break;
      t1 = s1, t2 = s2, x1 = y1, x2 = y2, miss = left;
    }
    bool known = false;
    for (const auto& y : out) known |= detail::same_angle(y.first, x1) && detail::same_angle(y.second, x2);
    if (!known && out.size() < 8) out.push_back({x1, x2, negative ? 1u : 0u});
  }
  detail::name_slots(out);
  return out;
}

/// Solves p0 + R(k1, t1) p1 = R(k2, t2)(p2 + R(k3, t3) p3). The component along k2 and the squared length are linear in
/// x1 and x3:
///
///   k2.p0 + k2.R(k1, t1) p1 = k2.p2 + k2.R(k3, t3) p3
///   |p0|^2 + |p1|^2 + 2 p0.R(k1, t1) p1 = |p2|^2 + |p3|^2 + 2 p2.R(k3, t3) p3          (2)
///
/// This is subproblem 6. t2 follows by subproblem 1, and Newton's steps where the squares have lost digits
/// (detail/three_axes_loop.hpp).
template <class S, class K1, class K2, class K3>
[[nodiscard]] detail::short_list<three_solved_angles<S>, 8> subproblem5(const vec3<S>& p0, const vec3<S>& p1,
                                                                        const vec3<S>& p2, const vec3<S>& p3,
                                                                        const K1& k1, const K2& k2, const K3& k3) {
  using std::sqrt;
  const vec3<S> k = as<S>(k2);
  const S unit = S(1) / sqrt(S(dot(p1, p1) + dot(p2, p2) + dot(p3, p3)));  // scales back to metres
  detail::short_list<three_solved_angles<S>, 8> out;
  // If axes 1 and 2 meet, or axes 2 and 3, only one angle occurs in the second equation; then subproblem 2 applies.
  const auto is_negligible = [&unit](const vec3<S>& p) { return !(dot(p, p) * unit * unit > S(1e-18)); };
  if (is_negligible(p0) && !is_negligible(p2)) {
    const auto t3 = detail::angles_of_length(k3, p2, p3, S(sqrt(dot(p1, p1))));
    for (const unsigned first : {0u, 2u}) {
      const auto& t = first == 0 ? t3.plus : t3.minus;
      const auto [t1, t2] = subproblem2(k1, p1, k, vec3<S>(p2 + turned(k3, t, p3)));
      out.push_back({t1.plus, t2.plus, t, first}), out.push_back({t1.minus, t2.minus, t, first + 1});
    }
    return out;
  }
  if (is_negligible(p2) && !is_negligible(p0)) {
    const auto t1 = detail::angles_of_length(k1, p0, p1, S(sqrt(dot(p3, p3))));
    for (const unsigned first : {0u, 2u}) {
      const auto& t = first == 0 ? t1.plus : t1.minus;
      const auto [t3, t2] = subproblem2(k3, p3, vec3<S>(-k), vec3<S>(p0 + turned(k1, t, p1)));
      out.push_back({t, t2.plus, t3.plus, first}), out.push_back({t, t2.minus, t3.minus, first + 1});
    }
    return out;
  }
  const auto l1 = linear_part_of(k, k1, p1), l3 = linear_part_of(k, k3, p3);
  const auto q1 = linear_part_of(p0, k1, p1), q3 = linear_part_of(p2, k3, p3);
  const S u = S(2) * unit;
  const S squares = (dot(p2, p2) + dot(p3, p3) - dot(p0, p0) - dot(p1, p1)) * unit;
  const detail::three_axes_loop<S> loop{detail::point_turned(p0, as<S>(k1), p1),
                                        detail::point_turned(p2, as<S>(k3), p3), k};
  for (const auto& t : subproblem6<S>(
           {{{l1.cos, l1.sin}, {u * q1.cos, u * q1.sin}}}, {{{-l3.cos, -l3.sin}, {-u * q3.cos, -u * q3.sin}}},
           {S(dot(k, p2) - dot(k, p0) + l3.constant - l1.constant), S(squares + u * (q3.constant - q1.constant))}))
    loop.add_closed(t.first, t.second, t.slot, out);
  return out;
}

}  // namespace kte
