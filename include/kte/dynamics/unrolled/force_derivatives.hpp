#pragma once

#include <kte/dynamics/unrolled/bodies.hpp>
#include <kte/dynamics/unrolled/given.hpp>
#include <kte/recursions/force_variations.hpp>

/// Derivatives of inverse dynamics of static chains (recursions/force_variations.hpp).
namespace kte::detail {

/// A joint or link with the motion of its parent, and the wrench that it exerts.
template <class Parent, class Load>
struct body_in_motion {
  Parent parent;
  Load load;
};

/// An inertia fixed to a frame, with the motion of the frame.
template <class Motion>
struct frame_in_motion {
  Motion motion;
};

template <class S, class Pass, class Axes>
class moving_bodies : public typed_bodies<S, Pass, Axes> {
  using base = typed_bodies<S, Pass, Axes>;

 public:
  using base::base;
  template <std::size_t I>
  KTE_INLINE constexpr auto body() const {
    using frame = typename base::template end<I>;
    using parent_type = decltype(this->motion_.template get<frame::what, base::template base_slot<I>>());
    using load_type = decltype(this->motion_.template load<frame::what, frame::slot>());
    return base::template body_with<I>(zero, [this]() KTE_INLINE_LAMBDA {
      return body_in_motion<parent_type, load_type>{
          this->motion_.template get<frame::what, base::template base_slot<I>>(),
          engine::fresh(this->motion_.template load<frame::what, frame::slot>())};
    });
  }
  template <class Frame, std::size_t N>
  KTE_INLINE constexpr auto fixed() const {
    using motion_of_frame = decltype(this->motion_.template get<Frame::what, Frame::slot>());
    return base::template fixed_with<Frame, N>([this]() KTE_INLINE_LAMBDA {
      return frame_in_motion<motion_of_frame>{this->motion_.template get<Frame::what, Frame::slot>()};
    });
  }
  static constexpr auto none() { return base::none_with(frame_in_motion<decltype(at_rest_)>{at_rest_}); }

 private:
  static constexpr auto at_rest_ = at_rest(no_rotation{}, zero3{});
};

template <class Matrix>
struct derivative_entries {
  Matrix &of_q, &of_v, &of_a;
  template <class X>
  KTE_INLINE constexpr void by_q(int i, int j, const X& x) const {
    of_q(i, j) = as<typename Matrix::Scalar>(x);
  }
  template <class X>
  KTE_INLINE constexpr void by_v(int i, int j, const X& x) const {
    of_v(i, j) = as<typename Matrix::Scalar>(x);
  }
  template <class X>
  KTE_INLINE constexpr void by_a(int i, int j, const X& x) const {
    of_a(i, j) = as<typename Matrix::Scalar>(x);
  }
};

/// Motion, forces, and the derivatives of the forces on joints, of a tree of joints.
template <class S, class Chain, class Given>
class unrolled_force_derivatives : public unrolled_passes<Chain, Given> {
  using passes = unrolled_passes<Chain, Given>;

 public:
  using matrix = joint_matrix<S, Chain::dofs>;

  /// Adds the derivatives to matrices of zeros.
  KTE_INLINE unrolled_force_derivatives(const Chain& c, const Given& g, matrix& by_q, matrix& by_v, matrix& by_a)
      : passes(c, g) {
    using bodies_type = moving_bodies<S, passes, axes_of_dofs<Chain>>;
    const bodies_type bodies(*this);
    derivatives_of_forces(engine::unrolled<bodies_type>{bodies}, derivative_entries<matrix>{by_q, by_v, by_a});
  }
};

}  // namespace kte::detail
