#pragma once

#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/runtime.hpp>

/// Frames of runtime chains: poses, velocities, accelerations, Jacobians, under the names they have on static chains
/// (dynamics/frame_motion.hpp, dynamics/jacobian.hpp). Bases are as the state has them. Nothing is allocated but the
/// Jacobian that is returned.
namespace kte {

namespace detail {

struct runtime_frame {
  kind what;
  int index;
};
inline runtime_frame find_frame(const kte_map_chain& c, runtime_state& s, std::string_view name) {
  c.check(s);
  const kind k = c.wiring().kind_of(name) == kind::frame_2D ? kind::frame_2D : kind::frame_3D;
  return {k, c.wiring().find(name, k)};
}
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
/// A load of six numbers on a frame, felt by the coordinates: from the frame to its base by the elements between them,
/// then from followers to what they follow. Leaves forces in the coordinates of the state.
inline void transmit_load(const topology& t, runtime_state& s, const runtime_frame& x,
                          const dense_wrench<double>& load) {
  for (std::size_t i = 0; i < s.plan.row_of_gen.size(); ++i) s.get<kind::gen>(static_cast<int>(i)).f = 0;
  for_each_listed_freedom(s, [](auto& c, const freedom&) {
    if constexpr (requires { clear_load(c); }) clear_load(c);
  });
  const auto load_on = [&w = s.work](kind k, int i) -> dense_wrench<double>& {
    return (k == kind::frame_2D ? w.frames.get<kind::frame_2D>(i) : w.frames.get<kind::frame_3D>(i)).load;
  };
  load_on(x.what, x.index) = load;
  kind k = x.what;
  for (int i = x.index, e; (e = t.writers[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)]) >= 0;) {
    const auto& mover = t.elements[static_cast<std::size_t>(e)];
    if (!mover.stiff) throw bad_argument("kte: a Jacobian needs joints and links, not " + mover.element->record().type);
    const std::size_t base = mover.index.size() - 2;
    k = mover.ports[base].what, i = mover.index[base];
    load_on(k, i) = {};
    mover.element->perform(steps::push{}, s);
  }
  push_followers(t, s);
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
  set_positions(s, q);
  return forward_kinematics(c, s);
}

/// The velocity and angular velocity of a frame in its own axes, as the state has bases and rates. Only the elements
/// between the bases and the frame are evaluated.
inline linear_angular<> frame_velocity(const kte_map_chain& c, runtime_state& s, std::string_view frame) {
  const auto x = detail::find_frame(c, s, frame);
  detail::check_state_velocities(s);
  detail::move(c.wiring(), s, x.what, x.index);
  return detail::with_motion(s, x, [](const auto& m) { return detail::checked<double>(m.velocity, m.ang_velocity); });
}
template <indexable Q, indexable V>
linear_angular<> frame_velocity(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v,
                                std::string_view frame) {
  set_positions(s, q), set_velocities(s, v);
  return frame_velocity(c, s, frame);
}

/// The acceleration of a frame, classical, in its own axes, without gravity, which the bases have in the state and
/// which is taken away here:
///
///   a + R^T g          (1)
inline linear_angular<> frame_acceleration(const kte_map_chain& c, runtime_state& s, std::string_view frame) {
  const auto x = detail::find_frame(c, s, frame);
  detail::check_state_velocities(s);
  detail::check_state(
      s, [](const auto& y, const auto& f) { visit_a(y, f); }, "kte: an acceleration is no finite number");
  detail::move(c.wiring(), s, x.what, x.index);
  const vec3<> g = x.what == kind::frame_2D ? vec3<>{c.gravity().x, c.gravity().y, 0.0} : c.gravity();
  return detail::with_motion(s, x, [&g](const auto& m) {
    return detail::checked<double>(m.acceleration + transpose(matrix(m.rotation)) * g, m.ang_acceleration);
  });
}
template <indexable Q, indexable V, indexable A>
linear_angular<> frame_acceleration(const kte_map_chain& c, runtime_state& s, const Q& q, const V& v, const A& a,
                                    std::string_view frame) {
  set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
  return frame_acceleration(c, s, frame);
}

/// The Jacobian of a frame, as on static chains. Row by row: row i is what a load of one along number i, on the frame,
/// makes on the coordinates (the transpose), through the elements between frame and base.
using runtime_jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

namespace detail {
inline runtime_jacobian jacobian_by_rows(const kte_map_chain& c, runtime_state& s, std::string_view frame, bool world) {
  const auto x = find_frame(c, s, frame);
  check_positions(s);
  move(c.wiring(), s, x.what, x.index);
  const auto axes = world ? with_motion(s, x, [](const auto& m) { return as<double>(transpose(matrix(m.rotation))); })
                          : as<double>(matrix(no_rotation{}));
  const auto columns_of_axes = transpose(axes);
  const vec3<> unit[]{columns_of_axes.x, columns_of_axes.y, columns_of_axes.z};
  runtime_jacobian j(6, s.dofs());
  for (int i = 0; i < 6; ++i) {
    transmit_load(c.wiring(), s, x, i < 3 ? dense_wrench<double>{unit[i], {}} : dense_wrench<double>{{}, unit[i - 3]});
    read_listed_numbers<vector_of::f>(s, s.work.forces);
    j.row(i) = s.work.forces.transpose();
  }
  return j;
}
}  // namespace detail

inline runtime_jacobian jacobian(const kte_map_chain& c, runtime_state& s, std::string_view frame) {
  return detail::jacobian_by_rows(c, s, frame, false);
}
inline runtime_jacobian jacobian(const kte_map_chain& c, runtime_state& s, std::string_view frame, in_world_axes_t) {
  return detail::jacobian_by_rows(c, s, frame, true);
}
template <indexable Q>
requires(!text_type<Q>) runtime_jacobian
    jacobian(const kte_map_chain& c, runtime_state& s, const Q& q, std::string_view frame) {
  set_positions(s, q);
  return detail::jacobian_by_rows(c, s, frame, false);
}
template <indexable Q>
requires(!text_type<Q>) runtime_jacobian
    jacobian(const kte_map_chain& c, runtime_state& s, const Q& q, std::string_view frame, in_world_axes_t) {
  set_positions(s, q);
  return detail::jacobian_by_rows(c, s, frame, true);
}

}  // namespace kte
