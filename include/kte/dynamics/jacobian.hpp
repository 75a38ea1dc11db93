#ifndef KTE_JACOBIAN_HPP
#define KTE_JACOBIAN_HPP

#include <kte/dynamics/detail/columns.hpp>
#include <kte/dynamics/detail/refused_calls.hpp>
#include <kte/dynamics/detail/velocities_at_unit_rates.hpp>
#include <kte/dynamics/frame_motion.hpp>

namespace kte {

/// Tag: rates of a frame at its origin, in axes of the world, in which the bases are given.
inline constexpr struct in_world_axes_t {
} in_world_axes;

namespace detail {
/// The elements from a base to a frame.
template <class Chain, kind K, int Slot>
struct branch {
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core_t = typename Chain::template core_type<I>;
  /// The frame that element I starts from, of its own kind; links and joints have it on their last port but one.
  static constexpr std::array<int, Chain::size + 1> base_of = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<int, Chain::size + 1>{
        wiring::slot(I, port_count<core_t<I>> < 2 ? 0 : port_count<core_t<I>> - 2)..., 0};
  }
  (std::make_index_sequence<Chain::size>{});
  static constexpr std::size_t length = [] {
    std::size_t n = 0;
    for (int w = wiring::writer(K, Slot); w >= 0; w = wiring::writer(K, base_of[std::size_t(w)])) ++n;
    return n;
  }();
  static constexpr std::array<std::size_t, length + 1> elements = [] {
    std::array<std::size_t, length + 1> e{};
    int w = wiring::writer(K, Slot);
    for (std::size_t n = length; n-- > 0; w = wiring::writer(K, base_of[std::size_t(w)])) e[n] = std::size_t(w);
    return e;
  }();
};

template <class S, class Chain, class Given, kind K, int Slot>
class local_jacobian : columns<S, Chain, Given> {
  using base = columns<S, Chain, Given>;
  using path = branch<Chain, K, Slot>;

 public:
  using base::base;
  using typename base::matrix_type;

  /// From the frame, which stands at x in the end of element N - 1 of the branch, to its base.
  template <std::size_t N = path::length, class X = pose<no_rotation, zero3>>
  KTE_INLINE void inward(const X& x = {}) {
    if constexpr (N > 0) {
      constexpr std::size_t i = path::elements[N - 1];
      base::template for_each_axis<i>([&]<int M>() KTE_INLINE_LAMBDA {
        const auto s = this->template axis<i, M>();
        const auto t = transpose(x.rotation);
        this->template put<i, M>(t * plus_cross(s.velocity, s.ang_velocity, x.position), t * s.ang_velocity);  // (1)
      });
      inward<N - 1>(compose(this->template pose_of_element<i>(), x));
    }
  }
  /// From the base to the frame, of which it returns the position; x is where the end of element N - 1 stands.
  template <std::size_t N = 0, class X = pose<no_rotation, zero3>>
  KTE_INLINE auto outward(const X& x = {}) {
    if constexpr (N == path::length) {
      return x.position;
    } else {
      constexpr std::size_t i = path::elements[N];
      const auto end = compose(x, this->template pose_of_element<i>());
      const auto p = outward<N + 1>(end);
      base::template for_each_axis<i>([&]<int M>() KTE_INLINE_LAMBDA {
        const auto s = this->template axis<i, M>();
        const auto w = end.rotation * s.ang_velocity;
        this->template put<i, M>(plus_cross(end.rotation * s.velocity, w, p - end.position), w);  // (2)
      });
      return p;
    }
  }
};

/// Whether only links and joints are on the way from a base to a frame.
template <class Chain, kind K, int Slot>
inline constexpr bool moves_stiffly = [] {
  constexpr int w = Chain::wiring::writer(K, Slot);
  if constexpr (w < 0) {
    return true;
  } else if constexpr (!is_transmission<core_of<Chain, std::size_t{w}>>) {
    return false;
  } else {
    return moves_stiffly<Chain, K, Chain::wiring::slot(std::size_t{w}, port_count<core_of<Chain, std::size_t{w}>> - 2)>;
  }
}();
/// Of a frame that follows others.
template <bool World, class S, class Frame, class Chain, class At>
auto jacobian_by_rates(const Chain& c, const At& at) {
  six_by_dofs<S, Chain::dofs> j;
  std::array<S, std::size_t{Chain::dofs}> rates{};
  constexpr same_base base{motion{zero3{}, no_rotation{}, zero3{}, zero3{}, skip{}, skip{}}};
  put_velocities_at_unit_rates<S>(j, rates, [&] {
    return velocities_of<S>(motion_at<Frame>(c, given{at, each<S, decltype(rates)>{rates}, same<skip>{}, base}), World);
  });
  return j;
}

/// Of one that does not.
template <bool World, class S, class Frame, class Chain, class At>
KTE_INLINE auto jacobian_along(const Chain& c, const At& at) {
  const given g{at, same<skip>{}, same<skip>{}, base_with_pose};
  using pass = local_jacobian<S, Chain, std::remove_const_t<decltype(g)>, Frame::what, frame_slot<Frame, Chain>()>;
  typename pass::matrix_type j;
  if constexpr (World) {
    pass(c, g, j).outward();
  } else {
    pass(c, g, j).inward();
  }
  return j;
}

template <bool World, class Frame, class Chain, class Q>
KTE_INLINE auto jacobian_of(const Chain& c, const Q& q) {
  using S = value_of<Q>;
  check_configuration<Chain>(q);
  const configuration<S, typename Chain::wiring, Q> at(q);
  at.check();
  if constexpr (!moves_stiffly<Chain, Frame::what, frame_slot<Frame, Chain>()>) {
    return jacobian_by_rates<World, S, Frame>(c, at);
  } else {
    return jacobian_along<World, S, Frame>(c, at);
  }
}
}  // namespace detail

/// The Jacobian of a frame: 6 x dofs, by which its velocity (rows 0 to 2, m/s) and angular velocity (rows 3 to 5,
/// rad/s), in its own axes, follow from the velocities v of the degrees of freedom. The column of axis s of a joint, in
/// whose end the frame stands at R, p, is (Siciliano et al., Robotics, 2009, section 3.1.3, in axes of the frame)
///
///   ( R^T (s_v + s_w x p), R^T s_w )          (1)
///
/// A coordinate that others follow, or that several joints share, has the sum of their columns; where a joint does not
/// move the frame there are zeros. Only the elements between base and frame are evaluated. A frame in the plane has
/// rows of zeros for what lies out of it.
///
///   jacobian(c, q, hand)             of a static chain, a value
///   jacobian(c, s, q, "hand")        of a runtime chain, a value; (c, s, "hand") at the positions of the state s
///   jacobian(c, s, q, "hand", j)     the same into memory of the caller's, below
///
/// Names and errors as in dynamics/frame_motion.hpp.
template <class Gravity, class... E, indexable Q, key_type Frame>
auto jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame&) {
  return detail::jacobian_of<false, Frame>(c, q);
}

/// The same in axes of the base, still at the origin of the frame ("local world aligned"); of a runtime chain in axes
/// of the world, in which bases are given. With the end of the joint standing at R_E, p_E and the origin of the frame
/// at p,
///
///   ( R_E s_v + R_E s_w x (p - p_E), R_E s_w )          (2)
template <class Gravity, class... E, indexable Q, key_type Frame>
auto jacobian(const static_chain<Gravity, E...>& c, const Q& q, const Frame&, in_world_axes_t) {
  return detail::jacobian_of<true, Frame>(c, q);
}

}  // namespace kte

#endif

// ---- of runtime chains (kte/dynamics/runtime_parts.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_JACOBIAN_OF_RUNTIME_CHAINS)
#define KTE_JACOBIAN_OF_RUNTIME_CHAINS

#include <kte/dynamics/detail/runtime_jacobian.hpp>

namespace kte {

/// Into memory of the caller's, which nothing is allocated for (but where coordinates follow others): a matrix, which
/// gets the size it needs, or 6 rows of a larger one, or a map.
///
///   Eigen::MatrixXd contacts(12, arm.dofs());
///   kte::jacobian(arm, s, q, left_foot, kte::in_world_axes, contacts.topRows<6>());
///   kte::jacobian(arm, s, q, right_foot, kte::in_world_axes, contacts.bottomRows<6>());
///
/// Throws `bad_argument` where it does not fit.
template <class S, detail::matrix_like J>
void jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame, J&& j) {
  detail::put_jacobian_at_state(c, s, frame, false, j);
}
template <class S, detail::matrix_like J>
void jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame, in_world_axes_t, J&& j) {
  detail::put_jacobian_at_state(c, s, frame, true, j);
}
template <class S, indexable Q, detail::matrix_like J>
requires(!names_something<Q>) void jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q,
                                            const name_or_handle& frame, J&& j) {
  detail::put_jacobian_at(c, s, q, frame, false, j);
}
template <class S, indexable Q, detail::matrix_like J>
requires(!names_something<Q>) void jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q,
                                            const name_or_handle& frame, in_world_axes_t, J&& j) {
  detail::put_jacobian_at(c, s, q, frame, true, j);
}
/// The same as a value.
template <class S>
basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame) {
  basic_runtime_jacobian<S> j;
  jacobian(c, s, frame, j);
  return j;
}
template <class S>
basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s, const name_or_handle& frame,
                                   in_world_axes_t axes) {
  basic_runtime_jacobian<S> j;
  jacobian(c, s, frame, axes, j);
  return j;
}
template <class S, indexable Q>
requires(!names_something<Q>) basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                                 const Q& q, const name_or_handle& frame) {
  basic_runtime_jacobian<S> j;
  jacobian(c, s, q, frame, j);
  return j;
}
template <class S, indexable Q>
requires(!names_something<Q>) basic_runtime_jacobian<S> jacobian(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                                 const Q& q, const name_or_handle& frame,
                                                                 in_world_axes_t axes) {
  basic_runtime_jacobian<S> j;
  jacobian(c, s, q, frame, axes, j);
  return j;
}

}  // namespace kte

#endif
