#pragma once

#include <kte/dynamics/unrolled/passes.hpp>
#include <kte/dynamics/unrolled/tree.hpp>
#include <kte/engine/unrolled.hpp>
#include <kte/math/plane_rotation.hpp>

/// The joints and links of a static chain as bodies of recursions (engine/body.hpp), each of its own type.
namespace kte::detail {

/// A frame: what engine/unrolled.hpp goes from and to.
template <kind K, int Slot>
struct frame_place {
  static constexpr kind what = K;
  static constexpr int slot = Slot;
};

/// Which axes a recursion knows. Of joints whose coordinates are degrees of freedom; of all joints, those of followers
/// in rows after the degrees of freedom.
template <class Chain>
struct axes_of_dofs {
  template <std::size_t I>
  static constexpr int axes = is_free_joint<Chain, I> ? joint_dofs<core_of<Chain, I>> : 0;
  template <std::size_t I>
  static constexpr int row =
      Chain::wiring::template at<coordinate_kind<core_of<Chain, I>>, Chain::wiring::slot(I, 0)>.v;
};
template <class Chain>
struct axes_of_joints {
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  static constexpr int axes = coordinates_of<core_of<Chain, I>> == 1 ? joint_dofs<core_of<Chain, I>> : 0;
  template <kind K, int Slot>
  static constexpr int row_of_coordinate =
      wiring::template is_free<K, Slot> ? wiring::template at<K, Slot>.v : wiring::dofs + Slot - wiring::gen_dofs;
  template <std::size_t I>
  static constexpr int row = row_of_coordinate<coordinate_kind<core_of<Chain, I>>, wiring::slot(I, 0)>;
};

/// Joint or link I of a chain that moves as `Motion` (unrolled_motion) says. Of a joint without axes here the motion is
/// given.
template <class S, class Motion, std::size_t I, class Axes>
struct typed_body {
  using scalar = S;
  using types = typename Motion::types;
  static constexpr std::size_t element = I;
  static constexpr kind what = types::template output_kind<I>;
  using end = frame_place<what, types::template output_slot<I>>;
  using base = frame_place<what, Motion::wiring::slot(I, port_count<typename types::template core<I>> - 2)>;
  const Motion& motion;

  static constexpr bool always_free = true;
  static constexpr bool free() { return true; }
  static constexpr int axes = Axes::template axes<I>;
  static constexpr int first() {
    if constexpr (axes > 0) {
      return Axes::template row<I>;
    } else {
      return 0;
    }
  }
  template <int K>
  KTE_INLINE constexpr auto axis() const {
    const auto s = motion.template joint_axis<I, K>();
    return engine::motion_vector{s.velocity, s.ang_velocity};
  }
  /// On the coordinate of the joint, besides what it moves.
  template <int>
  KTE_INLINE constexpr auto mass() const {
    return motion.template mass_on_coordinate<S, coordinate_kind<typename types::template core<I>>,
                                              Motion::wiring::slot(I, 0)>();
  }
  KTE_INLINE constexpr auto position() const { return motion.template joint_pose<I>().position; }
  template <class U>
  KTE_INLINE constexpr auto in(const U& u) const {
    return transpose(motion.template joint_pose<I>().rotation) * u;
  }
  template <class X, class Y, class Z>
  KTE_INLINE constexpr auto out(const vec3<X, Y, Z>& u) const {
    return motion.template joint_pose<I>().rotation * u;
  }
  template <class A>
  KTE_INLINE constexpr auto out(const A& a) const {
    return turned_by(matrix(motion.template joint_pose<I>().rotation), a);
  }
};
/// What is fixed to a frame as load Index of element I, which is no joint or link.
template <class S, class Motion, class Frame, std::size_t I, std::size_t Index>
struct fixed_part {
  using frame = Frame;
  static constexpr std::size_t element = I, index = Index;
  const Motion& motion;

  KTE_INLINE constexpr decltype(auto) core() const { return motion.chain().template core<I>(); }
  KTE_INLINE constexpr auto ang_velocity() const {
    return motion.template get<Frame::what, Frame::slot>().ang_velocity;
  }
  KTE_INLINE constexpr auto composite() const {
    if constexpr (has_mass<typename Motion::types::template core<I>, S>) {
      return core().template mass<S>();
    } else {
      return no_mass;
    }
  }
};
/// Nothing at all on a frame.
struct no_part {
  KTE_INLINE static constexpr auto composite() { return no_mass; }
  KTE_INLINE static constexpr zero3 ang_velocity() { return {}; }
};

/// The tree of them, as engine/unrolled.hpp sees it.
template <class S, class Motion, class Axes, template <class, class, std::size_t, class> class Body = typed_body>
struct typed_bodies {
  using wiring = typename Motion::wiring;
  template <std::size_t I>
  using core_t = typename Motion::types::template core<I>;
  template <std::size_t I>
  using body = Body<S, Motion, I, Axes>;
  const Motion& motion;

  template <class F>
  KTE_INLINE constexpr void each_base(const F& f) const {
    for_each_base<wiring>([&f]<kind K, int Slot>() KTE_INLINE_LAMBDA { f(frame_place<K, Slot>{}); });
  }
  template <class Frame>
  static constexpr std::size_t parts = loads_on<wiring, Frame::what, Frame::slot>.size();
  template <class Frame, std::size_t N>
  KTE_INLINE constexpr auto part() const {
    constexpr load_place place = loads_on<wiring, Frame::what, Frame::slot>[N];
    if constexpr (is_transmission<core_t<place.element>>) {
      return body_at<place.element>();
    } else {
      return fixed_part<S, Motion, Frame, place.element, place.index>{motion};
    }
  }
  template <class Frame>
  KTE_INLINE static constexpr no_part none() {
    return {};
  }
  /// Joint or link I.
  template <std::size_t I>
  KTE_INLINE constexpr body<I> body_at() const {
    return {motion};
  }
  template <class B, class F>
  KTE_INLINE constexpr void with_parent(const B&, const F& f) const {
    constexpr int below = wiring::writer(B::base::what, B::base::slot);
    if constexpr (below >= 0) {
      if constexpr (is_transmission<core_t<std::size_t{below}>>) f(body_at<std::size_t{below}>());
    }
  }
};

}  // namespace kte::detail
