#pragma once

#include <kte/dynamics/contacts/slow_sliding.hpp>

#include <algorithm>
#include <limits>

/// Accelerations with contacts in given modes, in the working memory of a state. Closed contacts satisfy
///
///   g'' = 0,   and u_t' = 0 where they stick                                              (1)
///
/// with forces lambda_n (n - mu d) where they slide, in the direction
///
///   d = sgn(u_t . d_0) u_t/|u_t|,   d_0: the direction when sliding began                 (2)
///
/// which stays smooth where u_t passes through zero; in space, slow sliding has that of slow_sliding.hpp. Forces are
/// those of least norm. Nothing limits them: contacts may pull, or exceed their friction; events find that time.
namespace kte::detail {

/// d of (2), or where sliding is slower than `slow`, m/s, a direction near that of slow_sliding.hpp.
vec3<> sliding_direction(const contact_at& x, const vec3<>& start, double slow);

/// Chooses the closed contacts, and their rows, by the modes of the state; call `m.find` first. `slow`: of
/// `sliding_direction`.
void put_rows_of_modes(const runtime_state& s, contact_solver& m, mode_rows& rows, double slow = 0);
/// Accelerations with contacts in the modes of the state, written to `forces` of the working memory. Contacts of the
/// state get their forces. Raises `no_solution` where (1) is singular.
void accelerate_in_modes(const chain_constraints& c, runtime_state& s, contact_solver& m, forces_in_modes& k);

#ifdef KTE_FUNCTION
KTE_FUNCTION vec3<> sliding_direction(const contact_at& x, const vec3<>& start, double slow) {
  const auto& n = x.place.normal;
  const vec3<> t = contact_workspace::tangential(x), t0 = unit_of(start - dot(n, start) * n);
  if (x.planar) {
    const vec3<> axis{n.y, -n.x, 0};
    return dot(axis, t0) < 0 ? -axis : axis;
  }
  const double share = (std::max)(slow - std::sqrt(dot(t, t)), 1e-30) / 3;
  return unit_of((dot(t, t0) < 0 ? -1.0 : 1.0) * t + share * t0);
}
KTE_FUNCTION void put_rows_of_modes(const runtime_state& s, contact_solver& m, mode_rows& rows, double slow) {
  const auto mode = [&s](const contact_at& x) { return mode_of(s.get<kind::contact>(x.slot)); };
  m.choose([&](const contact_at& x) { return mode(x) != contact_mode::open; });
  m.modes.clear(), rows.clear(m);
  for (std::size_t i = 0; i < m.touching.size(); ++i) {
    const auto& x = m.touched(i);
    m.modes.push_back(mode(x));
    const bool slides = m.modes.back() == contact_mode::slides;
    if (slides) m.let_slide(i, sliding_direction(x, s.get<kind::contact>(x.slot).direction, slow));
    for (int r = 0; r < x.rows(); ++r)
      rows.rows.push_back({m.touching[i], x.basis[static_cast<std::size_t>(r)], r == 0 || !slides});
  }
}
KTE_FUNCTION void accelerate_in_modes(const chain_constraints& c, runtime_state& s, contact_solver& m,
                                      forces_in_modes& k) {
  accelerate_freely(c, s, m, tree::given_forces<double>{});
  put_rows_of_modes(s, m, k.rows, k.slow_speed * m.equations.places.length);
  for (std::size_t i = 0; i < m.touching.size(); ++i) put_bias(m, i);
  k.rows.fill(c, s, m);
  k.rows.put_values(
      m, m.equations.acceleration, [](const contact_at&) { return vec3<>{}; }, k.bias);
  k.bias.tail(m.bias.size()) = m.bias;
  bool is_regular = k.solve(m);
  if (const auto slow = slow_contacts(m, k); !slow.empty()) is_regular = slow_sliding(m, k, slow, is_regular).solve();
  if (!is_regular) [[unlikely]]
    raise<no_solution>("kte: contacts " + names_of_touching(c, m) +
                       " cannot stay closed: their equations are singular");
  m.factor.other_half(s, m.equations, k.half, m.change_of_motion);
  auto& a = s.work.forces;
  a = m.before + m.change_of_motion;
  // Bodies at rest stay at rest: differences that are rounding errors are zero.
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (std::abs(a[i]) <= rounding * std::abs(m.before[i])) a[i] = 0;
  put_contacts(m, s);
}
#endif

}  // namespace kte::detail
