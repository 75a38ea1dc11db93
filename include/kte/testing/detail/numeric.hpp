#pragma once

#include <kte/contract/thing.hpp>

#include <array>
#include <limits>
#include <utility>

/// Derivatives by differences, and differences of numbers.
namespace kte::testing::detail {

template <class T>
concept frame = requires(const T& x) {
  load_of(x);
};
template <class T>
concept coordinate = requires(T& x) {
  update_angle(x);
};

template <class S>
S magnitude(const S& x) {
  return x < 0 ? S(-x) : x;
}
/// The larger one, or NaN.
template <class S>
S worse(const S& a, const S& b) {
  return a != a || a > b ? a : b;
}

/// First and second derivative at 0 of f, which returns an array of numbers, by five points. The errors, of order h^4
/// and eps/h^2, are smallest for h = eps^(1/6).
template <class S, class F>
auto derivatives(const F& f) {
  using std::pow;
  const S h = pow(std::numeric_limits<S>::epsilon(), S(1) / S(6));
  const auto m2 = f(S(-2 * h)), m1 = f(S(-h)), at = f(S(0)), p1 = f(h), p2 = f(S(2 * h));
  auto first = at, second = at;
  for (std::size_t i = 0; i < at.size(); ++i) {
    first[i] = (8 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12 * h);
    second[i] = (16 * (p1[i] + m1[i]) - (p2[i] + m2[i]) - 30 * at[i]) / (12 * h * h);
  }
  return std::pair{first, second};
}

/// The position of an item as numbers.
template <class S>
std::array<S, 1> numbers(const gen_coord<S>& c) {
  return {c.q};
}
template <frame Frame>
auto numbers(const Frame& x) {
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  const auto p = as<S>(spatial(x).position);
  const auto r = as<S>(matrix(spatial(x).rotation));
  return std::array<S, 12>{p.x, p.y, p.z, r.x.x, r.x.y, r.x.z, r.y.x, r.y.y, r.y.z, r.z.x, r.z.y, r.z.z};
}

/// |part| / whole; 0 if part is 0.
template <class S>
S ratio(const S& part, const S& whole) {
  return part == 0 ? S(0) : S(magnitude(part) / whole);
}
/// max |x - y| over components, relative to the largest of them or 1.
template <class S, std::size_t N>
S difference(const std::array<S, N>& x, const std::array<S, N>& y) {
  S most(1), d(0);
  for (std::size_t i = 0; i < N; ++i) {
    most = worse(most, worse(magnitude(x[i]), magnitude(y[i])));
    d = worse(d, magnitude(S(x[i] - y[i])));
  }
  return d / most;
}
/// The differences of rates from the derivatives of position and rotation: w from R^T R' = [w]x, al from the
/// skew-symmetric part of R^T R'' = [al]x + [w]x [w]x.
template <class S>
S off(const gen_coord<S>& c, const std::array<S, 1>& first, const std::array<S, 1>& second) {
  return difference<S, 2>({first[0], second[0]}, {c.q_dot, c.q_ddot});
}
template <class S, frame Frame>
S off(const Frame& frame, const std::array<S, 12>& first, const std::array<S, 12>& second) {
  const auto& x = spatial(frame);
  const auto t = transpose(as<S>(matrix(x.rotation)));
  const auto own_axes = [&](const std::array<S, 12>& d, const auto& v, const auto& w) {
    const vec3<S> p = t * vec3<S>{d[0], d[1], d[2]};
    const mat3<vec3<S>> r = t * mat3<vec3<S>>{{d[3], d[4], d[5]}, {d[6], d[7], d[8]}, {d[9], d[10], d[11]}};
    const auto V = as<S>(v), W = as<S>(w);
    return difference<S, 6>({p.x, p.y, p.z, (r.z.y - r.y.z) / 2, (r.x.z - r.z.x) / 2, (r.y.x - r.x.y) / 2},
                            {V.x, V.y, V.z, W.x, W.y, W.z});
  };
  return worse(own_axes(first, x.velocity, x.ang_velocity), own_axes(second, x.acceleration, x.ang_acceleration));
}

/// The power of the load on an item, and the sum of the absolute values of its terms.
template <template <class> class Coordinate, class S>
requires coordinate<Coordinate<S>> std::pair<S, S> power(const Coordinate<S>& c) {
  std::array<S, 6> v{}, f{};
  std::size_t i = 0, j = 0;
  kte::detail::visit_v(c, [&](const S& x) { v[i++] = x; });
  kte::detail::visit_f(c, [&](const S& x) { f[j++] = x; });
  S sum(0), sizes(0);
  for (std::size_t k = 0; k < i; ++k) sum = sum + f[k] * v[k], sizes = sizes + magnitude(S(f[k] * v[k]));
  return {sum, sizes};
}
template <frame Frame>
auto power(const Frame& x) {
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  const auto& m = spatial(x);
  const auto w = load_of(x);
  const auto v = as<S>(m.velocity), f = as<S>(w.force), o = as<S>(m.ang_velocity), t = as<S>(w.torque);
  const auto sizes = [](const vec3<S>& a, const vec3<S>& b) {
    return magnitude(S(a.x * b.x)) + magnitude(S(a.y * b.y)) + magnitude(S(a.z * b.z));
  };
  return std::pair<S, S>{dot(v, f) + dot(o, t), sizes(v, f) + sizes(o, t)};
}

/// The load on an item: on a coordinate one number, on a frame force and torque about the origin, in axes of the world.
template <class S>
std::array<S, 7> load_in_world(const gen_coord<S>& c) {
  return {c.f};
}
template <class S>
std::array<S, 7> load_in_world(const internal_state<S>&) {
  return {};
}
template <class S>
std::array<S, 7> load_in_world(const loop_state<S>&) {
  return {};
}
template <class S>
std::array<S, 7> load_in_world(const contact_state<S>&) {
  return {};
}
template <class S>
std::array<S, 7> load_in_world(const S&) {
  return {};
}
template <class S>
std::array<S, 7> load_in_world(const vec3<S>&) {
  return {};
}
template <frame Frame>
auto load_in_world(const Frame& frame) {
  using S = std::remove_cvref_t<decltype(frame.position.x)>;
  const auto& x = spatial(frame);
  const auto w = transmit(x, load_of(frame));
  const auto f = as<S>(w.force), t = as<S>(w.torque);
  return std::array<S, 7>{S(0), f.x, f.y, f.z, t.x, t.y, t.z};
}
template <class S>
std::pair<S, S> power(const internal_state<S>&) {
  return {S(0), S(0)};
}
template <class S>
std::pair<S, S> power(const loop_state<S>&) {
  return {S(0), S(0)};
}
template <class S>
std::pair<S, S> power(const contact_state<S>&) {
  return {S(0), S(0)};
}
template <class S>
std::pair<S, S> power(const S&) {  // an input
  return {S(0), S(0)};
}
template <class S>
std::pair<S, S> power(const vec3<S>&) {
  return {S(0), S(0)};
}
/// The largest sum of loads, relative to the loads.
template <class S>
S balance(const std::array<S, 7>& sum, const std::array<S, 7>& sizes) {
  S most(0), whole(0);
  for (std::size_t i = 0; i < 7; ++i) most = worse(most, magnitude(sum[i])), whole = worse(whole, sizes[i]);
  return ratio(most, whole);
}

/// Sets velocities to zero.
template <template <class> class Coordinate, class S>
requires coordinate<Coordinate<S>>
void stop(Coordinate<S>& c) {
  kte::detail::visit_v(c, [](S& x) { x = S(0); });
}
template <frame Frame>
void stop(Frame& x) {
  x.velocity = {}, x.ang_velocity = decltype(x.ang_velocity){};
}
/// Sets accelerations to zero.
template <template <class> class Coordinate, class S>
requires coordinate<Coordinate<S>>
void do_not_accelerate(Coordinate<S>& c) {
  kte::detail::visit_a(c, [](S& x) { x = S(0); });
}
template <frame Frame>
void do_not_accelerate(Frame& x) {
  x.acceleration = {}, x.ang_acceleration = decltype(x.ang_acceleration){};
}
template <class T>
void do_not_accelerate(T&) {}  // a signal
template <class T>
void stop(T&) {}

/// The load on an item as numbers, in its axes.
template <class S>
std::array<S, 6> own_load(const gen_coord<S>& c) {
  return {c.f};
}
template <frame Frame>
auto own_load(const Frame& x) {
  using S = std::remove_cvref_t<decltype(x.position.x)>;
  const auto w = load_of(x);
  const auto f = as<S>(w.force), t = as<S>(w.torque);
  return std::array<S, 6>{f.x, f.y, f.z, t.x, t.y, t.z};
}
/// The load due to the acceleration of a mass on an item at rest, in its axes.
template <class S, class Mass>
std::array<S, 6> resistance(const gen_coord<S>& c, const Mass& m) {
  return {-as<S>(m) * c.q_ddot};
}
template <frame Frame, class Mass>
auto resistance(const Frame& frame, const Mass& b) {
  using S = std::remove_cvref_t<decltype(frame.position.x)>;
  const auto& x = spatial(frame);
  const auto& a = x.acceleration;
  const auto& al = x.ang_acceleration;
  const auto g = as<S>(-(b.mass * a + cross(al, b.moment))), u = as<S>(-(b.inertia * al + cross(b.moment, a)));
  return std::array<S, 6>{g.x, g.y, g.z, u.x, u.y, u.z};
}

/// Moves an item with the world, which is rotated by r and shifted by p; items other than frames are unchanged.
template <class S>
void shift_world(frame_2D<S>& x, const mat3<vec3<S>>&, const vec3<S>& p) {
  const auto turn = rotation_by(p.z);
  x.position = turn * x.position + vec2<S>{p.x, p.y};
  x.rotation = turn * x.rotation;
}
template <class S>
void shift_world(frame_3D<S>& x, const mat3<vec3<S>>& r, const vec3<S>& p) {
  x.position = r * x.position + p;
  x.rotation = r * x.rotation;
}
template <class T, class R, class P>
void shift_world(T&, const R&, const P&) {}

}  // namespace kte::testing::detail
