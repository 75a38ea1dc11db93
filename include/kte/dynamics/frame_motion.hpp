#ifndef KTE_FRAME_MOTION_HPP
#define KTE_FRAME_MOTION_HPP

#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/unrolled/arguments.hpp>

/// The motion of frames and the poses of all frames. Static chains have bases at rest; runtime chains have the bases of
/// the state. Frames are named by keys (static chains), or by texts or handles (runtime chains); an unknown name throws
/// `unknown_name`. Arguments and other errors are those of `inverse_dynamics`. No memory is allocated.
namespace kte {

/// The poses of all frames of a chain, by key: `poses[elbow].position`, `poses[elbow].rotation`. `in_plane`,
/// `in_space`: the frames of each kind.
template <class S, class Wiring>
class frame_poses {
 public:
  using scalar = S;
  template <key_type Frame>
  constexpr const auto& operator[](const Frame&) const {
    static_assert(is_frame(Frame::what));
    constexpr int i = Wiring::template find<Frame>();
    static_assert(i >= 0, "kte: this chain has no frame of this name");
    return get<Frame::what>()[std::size_t{i < 0 ? 0 : i}];
  }
  /// All frames of a kind.
  template <kind K>
  constexpr const auto& get() const {
    if constexpr (K == kind::frame_2D) {
      return in_plane;
    } else {
      return in_space;
    }
  }

  std::array<pose<rotation_2D<S>, vec2<S>>, std::size_t{Wiring::count(kind::frame_2D)}> in_plane;
  std::array<pose<mat3<vec3<S>>, vec3<S>>, std::size_t{Wiring::count(kind::frame_3D)}> in_space;
};

namespace detail {
/// Linear and angular, unless they are too large.
template <class S, class L, class A, class Diagnose = too_large>
KTE_INLINE linear_angular<S> checked(const L& linear, const A& angular, const Diagnose& why = {"a result"}) {
  const linear_angular<S> r{as<S>(linear), as<S>(angular)};
  const S all[]{r.linear.x, r.linear.y, r.linear.z, r.angular.x, r.angular.y, r.angular.z};
  check_result(all, 6, why);
  return r;
}
template <class Frame, class Chain>
constexpr int frame_slot() {
  constexpr int slot = Chain::wiring::template find<Frame>();
  static_assert(slot >= 0 && is_frame(Frame::what), "kte: this chain has no frame of this name");
  return slot < 0 ? 0 : slot;
}
/// The motion of a frame. Quantities of bases and rates that are not needed are `skip`.
template <class Frame, class Chain, class Given>
KTE_INLINE auto motion_at(const Chain& c, const Given& g) {
  return motion_of<flow_types<Chain, Given>, Frame::what, frame_slot<Frame, Chain>()>(c, g);
}

inline constexpr same_base base_with_pose{motion{zero3{}, no_rotation{}, skip{}, skip{}, skip{}, skip{}}};
inline constexpr same_base base_at_rest{motion{zero3{}, no_rotation{}, zero3{}, zero3{}, zero3{}, zero3{}}};
inline constexpr same_base base_with_velocity{motion{skip{}, skip{}, zero3{}, zero3{}, skip{}, skip{}}};
inline constexpr same_base base_with_acceleration{motion{skip{}, skip{}, skip{}, zero3{}, zero3{}, zero3{}}};

/// The motion of a frame with bases at rest. `Bases` has the quantities that joints and links read. A frame that
/// follows others may read positions, and then gets bases with all quantities.
template <class Frame, class Chain, class At, class V, class A, class Bases>
KTE_INLINE auto motion_at_rest_bases(const Chain& c, const At& at, const V& v, const A& a, const Bases& bases) {
  using few = decltype(motion_at<Frame>(c, given{at, v, a, bases}));
  if constexpr (has_skip<decltype(few::velocity)>) {
    return motion_at<Frame>(c, given{at, v, a, base_at_rest});
  } else {
    return motion_at<Frame>(c, given{at, v, a, bases});
  }
}

template <class S, class Chain, class At>
KTE_INLINE auto all_poses(const Chain& c, const At& at) {
  using wiring = typename Chain::wiring;
  const given g{at, same<skip>{}, same<skip>{}, base_with_pose};
  const unrolled_motion<Chain, std::remove_const_t<decltype(g)>> m(c, g);
  return [&m]<std::size_t... P, std::size_t... Q>(std::index_sequence<P...>, std::index_sequence<Q...>)
      KTE_INLINE_LAMBDA {
    return frame_poses<S, wiring>{{pose_of<S, kind::frame_2D>(m.template get<kind::frame_2D, int{P}>())...},
                                  {pose_of<S, kind::frame_3D>(m.template get<kind::frame_3D, int{Q}>())...}};
  }
  (std::make_index_sequence<std::size_t{wiring::count(kind::frame_2D)}>{},
   std::make_index_sequence<std::size_t{wiring::count(kind::frame_3D)}>{});
}
}  // namespace detail

/// The poses of all frames. For a static chain: a table of rotations and positions, m, by key, relative to a base at
/// the origin. For a runtime chain: the state, whose frames have their positions and rotations in the world; for their
/// velocities and accelerations, too, call `doMotion`.
///
///   auto poses = kte::forward_kinematics(arm, q);                 poses[elbow].position.z
///   kte::forward_kinematics(arm, s, q).frame_3D("elbow").position.z
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto forward_kinematics(const static_chain<Gravity, E...>& c, const Q& q) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = detail::checked_arguments<chain_type>(q);
  const auto poses = detail::all_poses<S>(c, x.at);
  S zero_or_nan(0);
  for (const auto& [r, p] : poses.in_plane) zero_or_nan += (p.x + p.y) * S(0);
  for (const auto& [r, p] : poses.in_space) zero_or_nan += (p.x + p.y + p.z) * S(0);
  if (!all(zero_or_nan == S(0))) [[unlikely]]
    x.diagnosis("where a frame stands")();
  return poses;
}

/// The velocity of the origin of a frame, m/s, and its angular velocity, rad/s, in its own axes, with bases at rest:
/// the recursion (1), (2) of `compose` (frames/motion.hpp; Luh, Walker, Paul 1980) over the elements between base and
/// frame. It equals `jacobian(c, q, frame)` times v. Runtime chains: `frame_velocity(c, s, q, v, "hand")`, or
/// `frame_velocity(c, s, "hand")` at the positions and rates of the state s.
template <class Gravity, class... E, indexable Q, indexable V, key_type Frame>
[[nodiscard]] auto frame_velocity(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const Frame&) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q, v);
  const auto m = motion_at_rest_bases<Frame>(c, x.at, x.v, same<skip>{}, base_with_velocity);
  return checked<S>(m.velocity, m.ang_velocity, x.diagnosis("a velocity"));
}

/// The acceleration of the origin of a frame (second derivative of its position, m/s^2: classical) and its angular
/// acceleration, rad/s^2, in its own axes, with bases at rest, without gravity: (2), (3), (4) of `compose`. With the
/// Jacobian J in world axes (`in_world_axes`) and the rotation R of the frame it is R^T (J a + dJ/dt v). Runtime
/// chains: `frame_acceleration(c, s, q, v, a, "hand")` or `(c, s, "hand")`, without the gravity that bases have in the
/// state (dynamics/runtime/motion_in_world.hpp).
template <class Gravity, class... E, indexable Q, indexable V, indexable A, key_type Frame>
[[nodiscard]] auto frame_acceleration(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a,
                                      const Frame&) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q, v, a);
  const auto m = motion_at_rest_bases<Frame>(c, x.at, x.v, x.a, base_with_acceleration);
  return checked<S>(m.acceleration, m.ang_acceleration, x.diagnosis("an acceleration"));
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_FRAME_MOTION_OF_RUNTIME_CHAINS)
#define KTE_FRAME_MOTION_OF_RUNTIME_CHAINS

#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/runtime/motion_in_world.hpp>

namespace kte {

namespace detail {
template <class S>
void check_poses(const basic_runtime_state<S>& s) {
  const auto check = [&s]<kind K>() {
    for (int i = 0; i < s.made_for()->count(K); ++i) checked_pose(s, spatial(s.template get<K>(i)), K, i);
  };
  check.template operator()<kind::frame_2D>(), check.template operator()<kind::frame_3D>();
}
/// Sets the position and rotation of all frames from those of their bodies:
///
///   p = p_body + R_body r,   R = R_body R_r          for a frame at r, R_r in its body
///
/// Returns a sum that is finite only if all of them are.
template <class S>
S place_frames(basic_runtime_state<S>& s) {
  vec3<S> sum{};
  const auto place = [&s, &sum]<kind K>() {
    const auto& places = s.tree().body_tree.frames[K == kind::frame_2D ? 0 : 1];
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto& [slot, at, parallel] = places[i];
      const tree::world_place<S>& body = s.work.world[static_cast<std::size_t>(slot)];
      auto& x = s.template get<K>(static_cast<int>(i));
      const vec3<S> p = body.position + body.rotation * at.position;
      sum = sum + (p + body.rotation.x);
      if constexpr (K == kind::frame_3D) {
        x.position = p;
        x.rotation = parallel ? body.rotation : body.rotation * at.rotation;
      } else {
        x.position = {p.x, p.y};
        const vec3<S> along = body.rotation * vec3<S>{at.rotation.x.x, at.rotation.y.x, S(0)};
        x.rotation = {along.x, along.y};
      }
    }
  };
  place.template operator()<kind::frame_2D>(), place.template operator()<kind::frame_3D>();
  return sum.x + sum.y + sum.z;
}
/// Sets the poses of all frames: from those of bodies, or by passes if elements other than joints and links move some.
template <class S>
void move_frames(const runtime_chain& c, basic_runtime_state<S>& s) {
  if (s.tree().moves_unknown || !s.tree().written.empty()) {
    c.doMotion(s);
    return check_poses(s);
  }
  place_bodies(runtime_elements{c}, s);
  place_bodies_in_world<tree::world_place<S>>(s);
  const S sum = place_frames(s);
  if (!tree::all_finite_in_row(&sum, 1)) [[unlikely]]
    check_poses(s);
}
}  // namespace detail

template <class S>
const basic_runtime_state<S>& forward_kinematics(const runtime_chain& c, basic_runtime_state<S>& s) {
  static_assert(detail::goes_through_passes<S>);
  c.check(s);
  detail::check_positions(s);
  detail::move_frames(c, s);
  return s;
}
template <class S, indexable Q>
requires(!names_something<Q>) const basic_runtime_state<S>& forward_kinematics(const runtime_chain& c,
                                                                               basic_runtime_state<S>& s, const Q& q) {
  static_assert(detail::goes_through_passes<S>);
  return detail::take<detail::keeping::if_needed>(c, s, q).call([&]() -> const auto& {
    detail::move_frames(c, s);
    return s;
  });
}

namespace detail {
template <class S>
linear_angular<S> velocity_of(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  static_assert(goes_through_passes<S>);
  move(c.wiring(), s, x);
  return with_motion(s, x, [&s](const auto& m) {
    return checked<double>(m.velocity, m.ang_velocity, diagnose_state{"a velocity", s});
  });
}
template <class S>
linear_angular<S> acceleration_of(const runtime_chain& c, basic_runtime_state<S>& s, const runtime_frame& x) {
  return with_motion_in_world(c, s, x, [&s](const auto& m) {
    return checked<double>(m.acceleration, m.ang_acceleration, diagnose_state{"an acceleration", s});
  });
}
}  // namespace detail

template <class S>
linear_angular<S> frame_velocity(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  return detail::velocity_of(c, s, x);
}
template <class S, indexable Q, indexable V>
linear_angular<S> frame_velocity(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                 const name_or_handle& frame) {
  const auto x = detail::find_frame(c, frame);
  return detail::take(c, s, q, v).call([&] { return detail::velocity_of(c, s, x); });
}

template <class S>
linear_angular<S> frame_acceleration(const runtime_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame) {
  c.check(s);
  const auto x = detail::find_frame(c, frame);
  detail::check_state_velocities(s);
  detail::check_state(
      s, [](const auto& y, const auto& f) { visit_a(y, f); }, "kte: an acceleration is not finite");
  return detail::acceleration_of(c, s, x);
}
template <class S, indexable Q, indexable V, indexable A>
linear_angular<S> frame_acceleration(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                     const A& a, const name_or_handle& frame) {
  const auto x = detail::find_frame(c, frame);
  return detail::take(c, s, q, v, a).call([&] { return detail::acceleration_of(c, s, x); });
}

#ifdef KTE_EXTERN
namespace detail {
KTE_EXTERN template void move_frames(const runtime_chain&, runtime_state&);
KTE_EXTERN template linear_angular<double> velocity_of(const runtime_chain&, runtime_state&, const runtime_frame&);
KTE_EXTERN template linear_angular<double> acceleration_of(const runtime_chain&, runtime_state&, const runtime_frame&);
}  // namespace detail
#endif

}  // namespace kte

#endif
