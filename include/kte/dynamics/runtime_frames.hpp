#pragma once

#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/runtime.hpp>

/// Frames of runtime chains: poses, velocities, accelerations, Jacobians, under the names they have on static chains
/// (dynamics/frame_motion.hpp, dynamics/jacobian.hpp). Bases are as the state has them. Nothing is allocated but the
/// Jacobian that is returned.
namespace kte {

namespace detail {
/// f(motion) of a frame in its present state.
template <class F>
auto with_motion(runtime_state& s, const runtime_frame& x, const F& f) {
  return x.what == kind::frame_2D ? f(spatial(s.get<kind::frame_2D>(x.index)))
                                  : f(spatial(s.get<kind::frame_3D>(x.index)));
}
template <class X>
void check_state(const runtime_state& s, const X& visit, const char* what) {
  bool finite = true;
  for_each_listed_freedom(s, [&](const auto& c, const freedom&) { visit(c, [&](double x) { finite &= x - x == 0; }); });
  if (!finite) throw bad_argument(what);
}
inline void check_state_velocities(const runtime_state& s) {
  check_positions(s);
  check_state(
      s, [](const auto& c, const auto& f) { visit_v(c, f); }, "kte: a velocity is no finite number");
}

/// Forces on followers, to what they follow.
inline void push_followers(const topology& t, runtime_state& s) {
  for (const int e : s.plan.weights) {  // from the last to the first
    const auto& follower = t.elements[static_cast<std::size_t>(e)];
    if (follower.ports.back().how == access::out) follower.element->perform(steps::push{}, s);
  }
}
/// A matrix over all coordinates, whose rows are forces, over the degrees of freedom: what is on followers goes to what
/// they follow, and what is on coordinates that are given is left out.
inline Eigen::Matrix<double, 6, Eigen::Dynamic> folded(const topology& t, runtime_state& s,
                                                       Eigen::Matrix<double, 6, Eigen::Dynamic> a) {
  if (s.plan.coordinates == s.dofs()) return a;
  for (int i = 0; i < 6; ++i) {
    for_each_listed_freedom(s, [&](auto& x, const freedom& at) {
      int j = at.v;
      visit_f(x, [&](double& f) { f = a(i, j++); });
    });
    for (std::size_t g = 0; g < s.plan.row_of_gen.size(); ++g)
      s.get<kind::gen>(static_cast<int>(g)).f = a(i, s.plan.row_of_gen[g]);
    push_followers(t, s);
    read_listed_numbers<vector_of::f>(s, s.work.forces);
    a.row(i).head(s.dofs()) = s.work.forces.transpose();
  }
  return a.leftCols(s.dofs());
}
}  // namespace detail

/// All frames at the state's positions: in the state, which is returned.
///
///   kte::forward_kinematics(arm, s, q).frame_3D("elbow").position
inline const runtime_state& forward_kinematics(const kte_map_chain& c, runtime_state& s) {
  c.check(s);
  detail::check_positions(s);
  c.doMotion(s);
  return s;
}
/// The same at q, which is put into the state.
template <indexable Q>
requires(!text_type<Q>) const runtime_state& forward_kinematics(const kte_map_chain& c, runtime_state& s, const Q& q) {
  detail::take(c, s, q);
  c.doMotion(s);
  return s;
}

namespace detail {
inline linear_angular<> velocity_of(const kte_map_chain& c, runtime_state& s, const runtime_frame& x) {
  move(c.wiring(), s, x);
  return with_motion(s, x, [](const auto& m) { return checked<double>(m.velocity, m.ang_velocity); });
}
inline linear_angular<> acceleration_of(const kte_map_chain& c, runtime_state& s, const runtime_frame& x) {
  move(c.wiring(), s, x);
  const vec3<> all = c.gravity(), g = x.what == kind::frame_2D ? vec3<>{all.x, all.y, 0.0} : all;
  return with_motion(s, x, [&g](const auto& m) {
    return checked<double>(m.acceleration + transpose(matrix(m.rotation)) * g, m.ang_acceleration);
  });
}
}  // namespace detail

/// The velocity and angular velocity of a frame in its own axes, as the state has bases and rates. Only the elements
/// between the bases and the frame are evaluated.
inline linear_angular<> frame_velocity(const kte_map_chain& c, runtime_state& s, std::string_view frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  return detail::velocity_of(c, s, x);
}
template <indexable Q, indexable V>
linear_angular<> frame_velocity(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v,
                                std::string_view frame) {
  const auto x = detail::find_frame(c, frame);
  detail::take(c, s, q, v);
  return detail::velocity_of(c, s, x);
}

/// The acceleration of a frame, classical, in its own axes, without gravity, which the bases have in the state and
/// which is taken away here:
///
///   a + R^T g          (1)
inline linear_angular<> frame_acceleration(const kte_map_chain& c, runtime_state& s, std::string_view frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  detail::check_state(
      s, [](const auto& y, const auto& f) { visit_a(y, f); }, "kte: an acceleration is no finite number");
  return detail::acceleration_of(c, s, x);
}
template <indexable Q, indexable V, indexable A>
linear_angular<> frame_acceleration(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v, const A& a,
                                    std::string_view frame) {
  const auto x = detail::find_frame(c, frame);
  detail::take(c, s, q, v, a);
  return detail::acceleration_of(c, s, x);
}

/// The Jacobian of a frame, as on static chains.
using runtime_jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

namespace detail {
inline int writer_of(const topology& t, const runtime_frame& x) {
  return t.writers[static_cast<std::size_t>(x.what)][static_cast<std::size_t>(x.index)];
}
/// A frame and its base.
struct frame_on_base {
  runtime_frame frame, base;
};
inline frame_on_base find_frame_on_base(const kte_map_chain& c, std::string_view name) {
  const auto& t = c.wiring();
  frame_on_base x{find_frame(c, name), find_frame(c, name)};
  for (int e; (e = writer_of(t, x.base)) >= 0;) {
    const auto& mover = t.elements[static_cast<std::size_t>(e)];
    if (!mover.stiff) throw bad_argument("kte: a Jacobian needs joints and links, not " + mover.element->record().type);
    const std::size_t from = mover.index.size() - 2;
    x.base = {mover.ports[from].what, mover.index[from]};
  }
  return x;
}
/// At positions that are good.
inline runtime_jacobian jacobian_of(const kte_map_chain& c, runtime_state& s, const frame_on_base& x, bool world) {
  update_angles(s);
  const auto& t = c.wiring();
  const runtime_elements elements{c};
  if (s.plan.coordinates > s.dofs()) elements.forward<steps::follow>(s);
  auto& j = s.work.jacobian;
  j.setZero(6, s.plan.coordinates);
  s.work.seen = {as<double>(matrix(no_rotation{})), {}};
  elements.down_from<steps::inward>(writer_of(t, x.frame), s);
  if (world) {
    const auto axes =
        with_motion(s, x.base, [&s](const auto& m) { return as<double>(matrix(m.rotation) * s.work.seen.rotation); });
    for (int k = 0; k < j.cols(); ++k) {
      const vec3<> v = axes * vec3{j(0, k), j(1, k), j(2, k)}, w = axes * vec3{j(3, k), j(4, k), j(5, k)};
      j.col(k) << v.x, v.y, v.z, w.x, w.y, w.z;
    }
  }
  return folded(t, s, j);
}
inline runtime_jacobian jacobian_at_state(const kte_map_chain& c, runtime_state& s, std::string_view frame,
                                          bool world) {
  c.check(s);
  const auto x = find_frame_on_base(c, frame);
  check_positions(s);
  return jacobian_of(c, s, x, world);
}
template <class Q>
runtime_jacobian jacobian_at(const kte_map_chain& c, runtime_state& s, const Q& q, std::string_view frame, bool world) {
  const auto x = find_frame_on_base(c, frame);
  take(c, s, q);
  return jacobian_of(c, s, x, world);
}
}  // namespace detail

inline runtime_jacobian jacobian(const kte_map_chain& c, runtime_state& s, std::string_view frame) {
  return detail::jacobian_at_state(c, s, frame, false);
}
inline runtime_jacobian jacobian(const kte_map_chain& c, runtime_state& s, std::string_view frame, in_world_axes_t) {
  return detail::jacobian_at_state(c, s, frame, true);
}
template <indexable Q>
requires(!text_type<Q>) runtime_jacobian
    jacobian(const kte_map_chain& c, runtime_state& s, const Q& q, std::string_view frame) {
  return detail::jacobian_at(c, s, q, frame, false);
}
template <indexable Q>
requires(!text_type<Q>) runtime_jacobian
    jacobian(const kte_map_chain& c, runtime_state& s, const Q& q, std::string_view frame, in_world_axes_t) {
  return detail::jacobian_at(c, s, q, frame, true);
}

}  // namespace kte
