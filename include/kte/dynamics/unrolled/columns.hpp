#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/unrolled/tree.hpp>
#include <kte/engine/body.hpp>

/// Matrices with six rows, three linear and three angular, and a column for each degree of freedom.
namespace kte {

/// A 6 x dofs matrix, such as a Jacobian.
template <class S, int N>
using six_by_dofs = Eigen::Matrix<S, 6, N>;

namespace detail {

/// The joints and coordinates of a chain at `Given`, and a matrix for the effects of unit rates: all six rows, or the
/// three linear ones.
template <class S, class Chain, class Given, int Rows = 6>
class columns {
 public:
  using types = flow_types<Chain, Given>;
  using wiring = typename Chain::wiring;
  template <std::size_t I>
  using core_t = typename types::template core<I>;
  using matrix_type = Eigen::Matrix<S, Rows, Chain::dofs>;

  KTE_INLINE columns(const Chain& c, const Given& g, matrix_type& m) : chain_(c), given_(g), matrix_(m) { m.setZero(); }

  /// The pose of joint or link I at its current position.
  template <std::size_t I>
  KTE_INLINE constexpr auto pose_of_element() const {
    return element_pose<I>(chain_, given_);
  }
  /// Axis N of joint I, in the axes of its end.
  template <std::size_t I, int N>
  KTE_INLINE constexpr auto axis() const {
    const auto s = axis_of<N>(chain_.template core<I>(), coordinate_of_joint_at<I>(chain_, given_));
    return engine::motion_vector{s.velocity, s.ang_velocity};
  }
  /// Calls f<N>() for each axis of joint I.
  template <std::size_t I, class F>
  KTE_INLINE static constexpr void for_each_axis(const F& f) {
    if constexpr (coordinates_of < core_t < I >>> 0) unroll<joint_dofs<core_t<I>>>(f);
  }
  /// Adds the effect of the unit rate of axis N of joint I. For a dependent coordinate it is added to the leading
  /// coordinates by the chain rule; effects of joints that share a coordinate add up.
  template <std::size_t I, int N, class L, class A>
  KTE_INLINE void put(const L& linear, const A& angular) {
    if constexpr (coordinates_of < core_t < I >>> 1)
      put_on<kind::gen, wiring::slot(I, N), 0>(linear, angular);
    else
      put_on<coordinate_kind<core_t<I>>, wiring::slot(I, 0), N>(linear, angular);
  }

 private:
  template <kind K, int Slot, int N, class L, class A>
  KTE_INLINE void put_on(const L& linear, const A& angular) {
    if constexpr (wiring::template is_free<K, Slot>) {
      constexpr int j = wiring::template at<K, Slot>.v + N;
      put_number(matrix_(0, j), linear.x), put_number(matrix_(1, j), linear.y), put_number(matrix_(2, j), linear.z);
      if constexpr (Rows == 6)
        put_number(matrix_(3, j), angular.x), put_number(matrix_(4, j), angular.y),
            put_number(matrix_(5, j), angular.z);
    } else if constexpr (wiring::writer(K, Slot) >= 0) {  // q_end' = sum of ratio_p q_p'
      constexpr std::size_t w{wiring::writer(K, Slot)};
      unroll<int{input_count<core_t<w>>}>([&]<int P>() KTE_INLINE_LAMBDA {
        if constexpr (types::template what<w, P> == kind::gen) {
          const auto ratio = this->template rate_of_follower<w, P>(typename types::template inputs<w>{});
          this->template put_on<kind::gen, wiring::slot(w, P), 0>(ratio * linear, ratio * angular);
        }
      });
    }
  }
  /// The rate of a follower for the unit rate of the coordinate at port P.
  template <std::size_t W, int P, std::size_t... I>
  KTE_INLINE constexpr auto rate_of_follower(std::index_sequence<I...>) const {
    return chain_.template core<W>().doMotion(at_rate<W, I, I == std::size_t{P}>()...).q_dot;
  }
  template <std::size_t W, std::size_t I, bool Moves>
  KTE_INLINE constexpr auto at_rate() const {
    const auto c = motion_of<types, types::template what<W, I>, wiring::slot(W, I)>(chain_, given_);
    if constexpr (types::template what<W, I> != kind::gen) {
      return c;
    } else if constexpr (Moves) {
      return unit_rate<kind::gen, 0>(c);
    } else {
      return kte::coordinate{c.q, zero, zero, c.cos, c.sin};
    }
  }
  template <class X>
  KTE_INLINE static void put_number(S& to, const X& x) {
    if constexpr (is_tree_of_joints<Chain>) {
      to = as<S>(x);  // converted once
    } else if constexpr (!std::is_same_v<X, zero_t>) {
      to = as<S>(to + x);
    }
  }
  const Chain& chain_;
  const Given& given_;
  matrix_type& matrix_;
};

}  // namespace detail
}  // namespace kte
