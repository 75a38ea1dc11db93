#pragma once

#include <kte/recursions/axis_elimination.hpp>

/// recursions/axis_elimination.hpp for joints of several axes that are numbers: unit axes by their number, or axes of
/// any direction.
namespace kte::engine {

/// Eliminates axes that are numbers from I^A and p^A, as `eliminate_axes`: of `least` for each unit of length and
/// angle.
template <body B, class S, class Force>
[[gnu::noinline]] void eliminate_axes_of_numbers(const B& b, S (&m)[6][6], S (&p)[6], const S& least_linear,
                                                 const S& least_angular, const Force& force, axis_factors<S>* factors,
                                                 int& unmoved) {
  for (int k = b.axis_count(); k-- > 0;) {
    const auto& [v, w] = b.axis(k);
    const S s[6]{v.x, v.y, v.z, w.x, w.y, w.z};
    S u[6], gain[6], d = b.mass(k), rate = as<S>(force(k));
    for (int r = 0; r < 6; ++r) {
      u[r] = S(0);
      for (int c = 0; c < 6; ++c) u[r] += m[r][c] * s[c];
      d += s[r] * u[r], rate -= s[r] * p[r];
    }
    note(unmoved, b.first() + k, all(d > dot(v, v) * least_linear + dot(w, w) * least_angular), d);
    const S inverse = S(1) / d;
    rate *= inverse;
    for (int r = 0; r < 6; ++r) gain[r] = inverse * u[r], p[r] += rate * u[r];
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) m[r][c] -= u[r] * gain[c];
    factors[k] = {{{gain[0], gain[1], gain[2]}, {gain[3], gain[4], gain[5]}}, rate, inverse};
  }
}
/// `eliminated` for a joint of several unit axes with numbers known at run time, with I^A as a matrix of 6 x 6. If
/// nothing is passed on to the parent (`ends`), an axis needs only the rows of the axes before it. Axes given by
/// numbers are eliminated unchanged.
template <body B, class X, class Force, class S>
auto eliminated_by_number(const B& b, const X& x, const Force& force, axis_factors<S>* factors, bool ends,
                          int& unmoved) {
  if (!b.free()) return fresh(x);
  const auto& [a, h, j] = x.inertia;
  S m[6][6]{{a.xx, a.xy, a.xz, h.x.x, h.x.y, h.x.z}, {a.xy, a.yy, a.yz, h.y.x, h.y.y, h.y.z},
            {a.xz, a.yz, a.zz, h.z.x, h.z.y, h.z.z}, {h.x.x, h.y.x, h.z.x, j.xx, j.xy, j.xz},
            {h.x.y, h.y.y, h.z.y, j.xy, j.yy, j.yz}, {h.x.z, h.y.z, h.z.z, j.xz, j.yz, j.zz}};
  const auto& [f, t] = x.bias;
  S p[6]{as<S>(f.x), as<S>(f.y), as<S>(f.z), as<S>(t.x), as<S>(t.y), as<S>(t.z)};
  const S least = S(16) * std::numeric_limits<S>::epsilon(), linear = trace(a), angular = trace(j);
  bool unit_axes = true;
  if constexpr (requires { b.has_unit_axes(); }) {
    unit_axes = b.has_unit_axes();
    if (!unit_axes) [[unlikely]]
      eliminate_axes_of_numbers(b, m, p, least * linear, least * angular, force, factors, unmoved);
  }
  for (int k = unit_axes ? b.axis_count() : 0; k-- > 0;) {
    const int n = b.axis_number(k);
    const S d = m[n][n], tau = as<S>(force(k));
    note(unmoved, b.first() + k, all(d > least * (n < 3 ? linear : angular)), d);
    const S inverse = S(1) / d, rate = inverse * (tau - p[n]);
    S u[6], gain[6];
    for (int c = 0; c < 6; ++c) u[c] = m[n][c], gain[c] = inverse * u[c], p[c] += rate * u[c];
    for (int l = 0; l < (ends ? k : 6); ++l) {
      const int row = ends ? b.axis_number(l) : l;
      for (int c = 0; c < 6; ++c) m[row][c] -= u[row] * gain[c];
    }
    factors[k] = {{{gain[0], gain[1], gain[2]}, {gain[3], gain[4], gain[5]}}, rate, inverse};
    for (int c = 0; c < 6; ++c) m[n][c] = m[c][n] = S(0);  // nothing is left
    p[n] = tau;
  }
  X left;
  assign(left.inertia, articulated{sym3{m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2]},
                                   mat3{vec3{m[0][3], m[0][4], m[0][5]}, vec3{m[1][3], m[1][4], m[1][5]},
                                        vec3{m[2][3], m[2][4], m[2][5]}},
                                   sym3{m[3][3], m[3][4], m[3][5], m[4][4], m[4][5], m[5][5]}});
  assign(left.bias, wrench{vec3{p[0], p[1], p[2]}, vec3{p[3], p[4], p[5]}});
  return left;
}
/// `accelerated` for axes with numbers known at run time, or given by numbers.
template <class S, body B>
void accelerate_by_number(const B& b, const axis_factors<S>* factors, motion_vector<vec3<S>, vec3<S>>& a, S* change) {
  if constexpr (requires { b.has_unit_axes(); })
    if (!b.has_unit_axes()) [[unlikely]] {
      for (int k = 0; k < b.axis_count(); ++k) {
        const auto& s = b.axis(k);
        change[k] = factors[k].rate - power(a, factors[k].gain);
        a = {a.linear + change[k] * s.linear, a.angular + change[k] * s.angular};
      }
      return;
    }
  S* const all[]{&a.linear.x, &a.linear.y, &a.linear.z, &a.angular.x, &a.angular.y, &a.angular.z};
  for (int k = 0; k < b.axis_count(); ++k) {
    S& along = *all[b.axis_number(k)];
    const S before = along;
    along = S(0);
    along = factors[k].rate - power(a, factors[k].gain);
    change[k] = along - before;
  }
}

}  // namespace kte::engine
