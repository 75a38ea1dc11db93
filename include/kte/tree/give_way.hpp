#pragma once

#include <kte/math/select.hpp>
#include <kte/tree/lanes.hpp>
#include <kte/tree/newton_euler.hpp>

#include <limits>

/// How a joint gives way to what its body carries (tree/articulated.hpp).
namespace kte::tree {

/// Below this, what moves along an axis is nothing but rounding of what does not.
template <class S>
KTE_INLINE S least_mass(const S& linear, const S& angular) {
  return S(16) * std::numeric_limits<S>::epsilon() * (linear + angular);
}

/// What is to be added to the parent: the articulated inertia of a body and its load, at its own origin.
template <class S>
struct burden {
  articulated_inertia<S> inertia;
  dense_wrench<S> load;
};
/// Of a body with all it carries, in axes of the parent, but about its own origin: about that of the parent, by (2) of
/// frames/articulated.hpp.
template <class P, class S>
KTE_INLINE burden<S> seen_from_parent(const placed<P, S>& at, const sym3<S>& linear, const mat3<vec3<S>>& coupling,
                                      const sym3<S>& angular, const dense_wrench<S>& load) {
  return {shifted(at.at.position, kte::articulated{linear, coupling, angular}), at.out(load)};
}

/// A joint about z gives way: with U = I s, D = s.U + m, W' the load less what the drift takes,
///
///   gain = U / D,  rate = (f + s.W) / D,  I' = I - U gain^T,  W' = W - I' drift - U rate         (1)
///
/// Along s, I' is nothing and W' is -f. What is carried, `x`, is then seen from the parent, unless that is a base.
template <class P, class S>
KTE_INLINE bool give_way_about_z(const record<P>& r, const spot<S>& at, const S& f, const vec3<S>& da,
                                 const vec3<S>& dal, burden<S>& x, axis_answer<S>& answer, bool on_base) {
  const auto& [a, h, j] = x.inertia;
  const vec3<S> u{h.x.z, h.y.z, h.z.z}, t{j.xz, j.yz, j.zz};
  const bool good = all(t.z > least_mass(S(0), j.xx + (j.yy + j.zz)));
  const S inverse = S(1) / t.z;
  const vec3<S> gu = inverse * u, gt{inverse * t.x, inverse * t.y, S(1)};
  const S rate = inverse * (f + x.load.torque.z);
  answer = {{gu, gt}, rate, inverse};
  if (on_base) return good;

  const sym3<S> linear{a.xx - u.x * gu.x, a.xy - u.x * gu.y, a.xz - u.x * gu.z,
                       a.yy - u.y * gu.y, a.yz - u.y * gu.z, a.zz - u.z * gu.z};
  // Columns x and y of the coupling, and the corner of the angular part: the rest is nothing.
  const vec3<S> hx{h.x.x - u.x * gt.x, h.y.x - u.y * gt.x, h.z.x - u.z * gt.x};
  const vec3<S> hy{h.x.y - u.x * gt.y, h.y.y - u.y * gt.y, h.z.y - u.z * gt.y};
  const S jxx = j.xx - t.x * gt.x, jxy = j.xy - t.x * gt.y, jyy = j.yy - t.y * gt.y;
  const dense_wrench<S> load{x.load.force - (linear * da + (dal.x * hx + dal.y * hy)) - rate * u,
                             {x.load.torque.x - (dot(hx, da) + (jxx * dal.x + jxy * dal.y)) - rate * t.x,
                              x.load.torque.y - (dot(hy, da) + (jxy * dal.x + jyy * dal.y)) - rate * t.y, -f}};

  const turn<S>& z = at.angle;
  const turn<P>& tilt = r.tilt;
  const auto cc = z.cos * z.cos, ss = z.sin * z.sin, cs = z.cos * z.sin;
  const S twice = (cs + cs) * jxy;
  const S kxx = cc * jxx - twice + ss * jyy, kxy = cs * (jxx - jyy) + (cc - ss) * jxy,
          kyy = ss * jxx + twice + cc * jyy;
  const vec3<S> mx = out_z(z, hx), my = out_z(z, hy);  // R H, then R H R^T
  const vec3<S> nx = out_x(tilt, vec3<S>(z.cos * mx - z.sin * my)), ny = out_x(tilt, vec3<S>(z.sin * mx + z.cos * my));
  sym3<S> m1 = out_x(tilt, out_z(z, linear));
  sym3<S> j1{kxx,
             tilt.cos * kxy,
             tilt.sin * kxy,
             (tilt.cos * tilt.cos) * kyy,
             (tilt.cos * tilt.sin) * kyy,
             (tilt.sin * tilt.sin) * kyy};
  mat3<vec3<S>> h1{{nx.x, tilt.cos * ny.x, tilt.sin * ny.x},
                   {nx.y, tilt.cos * ny.y, tilt.sin * ny.y},
                   {nx.z, tilt.cos * ny.z, tilt.sin * ny.z}};
  if (r.turned) m1 = out_z(r.before, m1), j1 = out_z(r.before, j1), h1 = out_z(r.before, h1);
  x = seen_from_parent(placed<P, S>{r, at}, m1, h1, j1, load);
  return good;
}

/// The same along an axis (s, sw) of any kind; a further mass on it keeps something of I along it.
template <class P, class S>
KTE_INLINE bool give_way_along(const record<P>& r, const S& force, const P& own_mass, burden<S>& x,
                               axis_answer<S>& answer) {
  auto& [a, h, j] = x.inertia;
  const S one(1);
  vec3<S> s{}, sw{};
  along_axes(r, &one, s, sw);
  const dense_wrench<S> u{a * s + h * sw, transpose(h) * s + j * sw};
  const S d = (dot(s, u.force) + dot(sw, u.torque)) + own_mass;
  const bool good = all(d > least_mass(S(dot(s, s) * trace(a)), S(dot(sw, sw) * trace(j))));
  const S inverse = S(1) / d;
  const dense_wrench<S> gain{inverse * u.force, inverse * u.torque};
  const S rate = inverse * (force + (dot(s, x.load.force) + dot(sw, x.load.torque)));
  answer = {gain, rate, inverse};
  a = detail::less_dyad(a, u.force, gain.force);
  h = detail::less_dyad(h, u.force, gain.torque);
  j = detail::less_dyad(j, u.torque, gain.torque);
  x.load = {x.load.force - rate * u.force, x.load.torque - rate * u.torque};
  if (r.moves == joint::prismatic && own_mass == P(0)) {  // nothing at all is left
    a.xz = a.yz = a.zz = S(0);
    h.z = {};
    x.load.force.z = -force;
  }
  return good;
}
/// The same by a joint of several unit axes, from the last, of which the first is returned that moves nothing, or -1:
/// on I as a matrix of 6 x 6, in rows of 8 for the sake of registers. On a base only the answers are wanted: axis k
/// then needs no more than the rows of those before it.
template <class P, class S>
int give_way_by_several(const record<P>& r, const S* force, const P* own_mass, burden<S>& x, axis_answer<S>* answers,
                        bool on_base) {
  auto& [a, h, j] = x.inertia;
  alignas(32) S m[6][8]{
      {a.xx, a.xy, a.xz, h.x.x, h.x.y, h.x.z, S(0), S(0)}, {a.xy, a.yy, a.yz, h.y.x, h.y.y, h.y.z, S(0), S(0)},
      {a.xz, a.yz, a.zz, h.z.x, h.z.y, h.z.z, S(0), S(0)}, {h.x.x, h.y.x, h.z.x, j.xx, j.xy, j.xz, S(0), S(0)},
      {h.x.y, h.y.y, h.z.y, j.xy, j.yy, j.yz, S(0), S(0)}, {h.x.z, h.y.z, h.z.z, j.xz, j.yz, j.zz, S(0), S(0)}};
  alignas(32) S w[8]{x.load.force.x,  x.load.force.y,  x.load.force.z, x.load.torque.x,
                     x.load.torque.y, x.load.torque.z, S(0),           S(0)};
  int bad = -1;
  const S linear = trace(a), angular = trace(j);
  for (int k = r.axes; k-- > 0;) {
    const int n = r.axis[static_cast<std::size_t>(k)];
    const S d = m[n][n] + own_mass[k];
    if (bad < 0 && !all(d > (n < 3 ? least_mass(linear, S(0)) : least_mass(S(0), angular)))) [[unlikely]]
      bad = k;
    const S inverse = S(1) / d, rate = inverse * (force[k] + w[n]);
    alignas(32) S u[8], gain[8];
    by_lanes<S>(0, 6, [&](int c) KTE_INLINE_LAMBDA {
      lanes<S> row, load_left;
      load<S>(row, m[n] + c), load<S>(load_left, w + c);
      store<S>(row, u + c), store<S>(inverse * row, gain + c);
      store<S>(load_left - rate * row, w + c);
    });
    for (int l = 0; l < (on_base ? k : 6); ++l) {
      const int i = on_base ? r.axis[static_cast<std::size_t>(l)] : l;
      by_lanes<S>(0, 6, [&](int c) KTE_INLINE_LAMBDA {
        lanes<S> row, by;
        load<S>(row, m[i] + c), load<S>(by, gain + c);
        store<S>(row - u[i] * by, m[i] + c);
      });
    }
    answers[k] = {{{gain[0], gain[1], gain[2]}, {gain[3], gain[4], gain[5]}}, rate, inverse};
    if (own_mass[k] != P(0)) continue;
    for (int c = 0; c < 6; ++c) m[n][c] = m[c][n] = S(0);  // nothing at all is left
    w[n] = -force[k];
  }
  if (on_base) return bad;
  x.inertia = {{m[0][0], m[0][1], m[0][2], m[1][1], m[1][2], m[2][2]},
               {{m[0][3], m[0][4], m[0][5]}, {m[1][3], m[1][4], m[1][5]}, {m[2][3], m[2][4], m[2][5]}},
               {m[3][3], m[3][4], m[3][5], m[4][4], m[4][5], m[5][5]}};
  x.load = {{w[0], w[1], w[2]}, {w[3], w[4], w[5]}};
  return bad;
}
/// The same by any joint, of which the first axis is returned that moves nothing, or -1. Where the acceleration of the
/// joint is given, all that its body carries goes on.
template <class P, class S>
[[gnu::noinline]] int give_way(const record<P>& r, const spot<S>& at, bool yields, const S* force, const P* own_mass,
                               const vec3<S>& da, const vec3<S>& dal, burden<S>& x, axis_answer<S>* answers,
                               bool on_base) {
  int bad = -1;
  if (yields && r.moves == joint::several)
    bad = give_way_by_several(r, force, own_mass, x, answers, on_base);
  else if (yields && !give_way_along(r, *force, *own_mass, x, *answers))
    bad = 0;
  if (on_base) return bad;
  const auto& [a, h, j] = x.inertia;
  const dense_wrench<S> load{x.load.force - (a * da + h * dal), x.load.torque - (transpose(h) * da + j * dal)};
  const placed<P, S> seat{r, at};
  x = seen_from_parent(seat, seat.out(a), seat.out(h), seat.out(j), load);
  return bad;
}

}  // namespace kte::tree
