#pragma once

#include <kte/dynamics/unrolled/passes.hpp>
#include <kte/dynamics/unrolled/tree.hpp>
#include <kte/engine/unrolled.hpp>
#include <kte/math/plane_rotation.hpp>

/// The joints and links of a static chain as bodies of recursions (engine/body.hpp), by type.
namespace kte::detail {

/// A frame: the start or end of a recursion in engine/unrolled.hpp.
template <kind K, int Slot>
struct frame_place {
  static constexpr kind what = K;
  static constexpr int slot = Slot;
};

/// The axes in a recursion: those of joints whose coordinates are degrees of freedom; or those of all joints, followers
/// in the rows after the degrees of freedom.
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
  static constexpr int axes = coordinates_of<core_of<Chain, I>> > 0 ? joint_dofs<core_of<Chain, I>> : 0;
  template <kind K, int Slot>
  static constexpr int row_of_coordinate =
      wiring::template is_free<K, Slot> ? wiring::template at<K, Slot>.v : wiring::dofs + Slot - wiring::gen_dofs;
  template <std::size_t I>
  static constexpr int row = row_of_coordinate<coordinate_kind<core_of<Chain, I>>, wiring::slot(I, 0)>;
};

/// A joint or link of a chain in its current position. The type describes the joint but does not identify it, so that
/// the steps of recursions are instantiated once for all joints of equal type. It stores the inputs of poses and
/// motions, because g++ would keep copies of the results in memory.
///   C      the type of its coordinate, or of its source; `engine::no_value` for a link
///   Axes   the number of its axes in the recursion; 0: its motion is given
///   M      a further mass on its coordinate
///   More   further data of a recursion
template <class S, class Core, class C, int Axes, class M, class More>
struct typed_body {
  using scalar = S;
  const Core& core;
  C at;
  int row;  ///< of its first axis
  M own_mass;
  More more;

  static constexpr bool always_free = true;
  static constexpr bool free() { return true; }
  static constexpr int axes = Axes;
  KTE_INLINE constexpr int first() const { return row; }
  template <int K>
  KTE_INLINE constexpr auto axis() const {
    const auto s = axis_of<K>(core, coordinate());
    return engine::motion_vector{s.velocity, s.ang_velocity};
  }
  template <int>
  KTE_INLINE constexpr auto mass() const {
    return own_mass;
  }
  KTE_INLINE constexpr auto position() const { return placed().position; }
  template <class U>
  KTE_INLINE constexpr auto in(const U& u) const {
    return transpose(placed().rotation) * u;
  }
  template <class X, class Y, class Z>
  KTE_INLINE constexpr auto out(const vec3<X, Y, Z>& u) const {
    return placed().rotation * u;
  }
  template <class Matrix>
  KTE_INLINE constexpr auto out(const Matrix& a) const {
    return turned_by(matrix(placed().rotation), a);
  }
  /// The motion of the joint.
  KTE_INLINE constexpr auto relative() const {
    if constexpr (std::is_same_v<C, engine::no_value>) {
      return core.relative();
    } else {
      return relative_at(core, coordinate());
    }
  }
  // For recursions with this data (recursions/force_variations.hpp).
  KTE_INLINE constexpr const auto& parent_motion() const requires requires(const More& m) { m.parent; }
  { return more.parent; }
  KTE_INLINE constexpr const auto& load() const requires requires(const More& m) { m.load; }
  { return more.load; }

 private:
  KTE_INLINE constexpr decltype(auto) coordinate() const {
    if constexpr (requires { at.taken(); }) {
      return at.taken();
    } else {
      return (at);
    }
  }
  KTE_INLINE constexpr auto placed() const {
    if constexpr (std::is_same_v<C, engine::no_value>) {
      return core.relative();
    } else {
      return relative_at(core, position_only(coordinate()));
    }
  }
};

/// Reads the coordinate of joint I, a rotation or a pose, without a copy in memory.
template <class Motion, std::size_t I>
struct coordinate_of_joint {
  const Motion& motion;
  KTE_INLINE constexpr decltype(auto) taken() const { return motion.template joint_coordinate<I>(); }
};

/// An element fixed to a frame, or none: its mass, about the origin, and further data of a recursion.
template <class S, class Core, class More>
struct fixed_part {
  const Core& core;
  More more;
  KTE_INLINE constexpr auto composite() const {
    if constexpr (has_mass<Core, S>) {
      return core.template mass<S>();
    } else {
      return no_mass;
    }
  }
};
struct no_element {};
inline constexpr no_element nothing_fixed{};

/// The joints and links of a chain that moves by `Motion` (unrolled_motion). For a joint without axes here the motion
/// is given.
template <class S, class Motion, class Axes>
class typed_bodies {
 protected:
  using types = typename Motion::types;
  using wiring = typename Motion::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  template <std::size_t I>
  static constexpr int base_slot = wiring::slot(I, port_count<core_t<I>> - 2);

 public:
  KTE_INLINE constexpr explicit typed_bodies(const Motion& m) : motion_(m) {}

  template <class F>
  KTE_INLINE constexpr void each_base(const F& f) const {
    for_each_base<wiring>([&f]<kind K, int Slot>() KTE_INLINE_LAMBDA { f(frame_place<K, Slot>{}); });
  }
  template <class Frame>
  static constexpr std::size_t parts = loads_on<wiring, Frame::what, Frame::slot>.size();
  template <class Frame, std::size_t N>
  static constexpr load_place place = loads_on<wiring, Frame::what, Frame::slot>[N];
  template <class Frame, std::size_t N>
  static constexpr int body_on = is_transmission<core_t<place<Frame, N>.element>>
                                     ? static_cast<int>(place<Frame, N>.element)
                                     : -1;
  template <std::size_t I>
  using end = frame_place<types::template output_kind<I>, types::template output_slot<I>>;
  template <std::size_t I>
  static constexpr int parent = [] {
    constexpr int below = wiring::writer(types::template output_kind<I>, base_slot<I>);
    if constexpr (below < 0) {
      return -1;
    } else {
      return is_transmission<core_t<std::size_t{below}>> ? below : -1;
    }
  }();
  template <std::size_t I>
  KTE_INLINE constexpr auto body() const {
    return body_with<I>(zero, []() KTE_INLINE_LAMBDA { return engine::no_value{}; });
  }
  template <class Frame, std::size_t N>
  KTE_INLINE constexpr auto fixed() const {
    return fixed_with<Frame, N>([]() KTE_INLINE_LAMBDA { return engine::no_value{}; });
  }
  static constexpr auto none() { return none_with(engine::no_value{}); }

 protected:
  /// The mass on the coordinate of joint I; zero without axes here.
  template <std::size_t I>
  KTE_INLINE constexpr auto own_mass() const {
    if constexpr (Axes::template axes<I> == 0) {
      return zero;
    } else {
      return motion_.template mass_on_coordinate<S, coordinate_kind<core_t<I>>, wiring::slot(I, 0)>();
    }
  }
  /// Returns the body with more(), which is constructed in place.
  template <std::size_t I, class M, class MakeMore>
  KTE_INLINE constexpr auto body_with(const M& mass, const MakeMore& more) const {
    using More = decltype(more());
    constexpr int row = [] {
      if constexpr (Axes::template axes < I >> 0) {
        return Axes::template row<I>;
      } else {
        return 0;
      }
    }();
    constexpr int axes = Axes::template axes<I>;
    const auto& core = motion_.chain().template core<I>();
    static_assert(rule < core_t<I>, void, coordinates_of<core_t<I>><2 || consecutive_rows<I>()>,
                  "kte: the coordinates of this joint of several are not consecutive degrees of freedom, as this "
                  "algorithm needs: name them first in this joint, or use a runtime chain");
    if constexpr (coordinates_of<core_t<I>> == 0) {
      return typed_body<S, core_t<I>, engine::no_value, axes, M, More>{core, {}, row, mass, more()};
    } else if constexpr (coordinate_kind<core_t<I>> == kind::gen) {
      using coordinate = std::remove_cvref_t<decltype(motion_.template joint_coordinate<I>())>;
      return typed_body<S, core_t<I>, coordinate, axes, M, More>{core, motion_.template joint_coordinate<I>(), row,
                                                                 mass, more()};
    } else {
      return typed_body<S, core_t<I>, coordinate_of_joint<Motion, I>, axes, M, More>{
          core, {motion_}, row, mass, more()};
    }
  }
  template <class Frame, std::size_t N, class MakeMore>
  KTE_INLINE constexpr auto fixed_with(const MakeMore& more) const {
    constexpr std::size_t e = place<Frame, N>.element;
    return fixed_part<S, core_t<e>, decltype(more())>{motion_.chain().template core<e>(), more()};
  }
  template <class More>
  static constexpr auto none_with(const More& more) {
    return fixed_part<S, no_element, More>{nothing_fixed, more};
  }

  const Motion& motion_;

 private:
  template <std::size_t I>
  static constexpr bool consecutive_rows() {
    const auto& rows = static_plan<typename Motion::chain_type>.row_of_gen;
    for (std::size_t k = 1; k < coordinates_of<core_t<I>>; ++k)
      if (rows[std::size_t(wiring::slot(I, k))] != rows[std::size_t(wiring::slot(I, 0))] + static_cast<int>(k))
        return false;
    return true;
  }
};

}  // namespace kte::detail
