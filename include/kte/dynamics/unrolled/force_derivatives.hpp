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

/// Writes the entries of a matrix.
template <class Matrix>
struct entries_of {
  Matrix& to;
  template <class X>
  KTE_INLINE constexpr void operator()(int i, int j, const X& x) const {
    to(i, j) = as<typename Matrix::Scalar>(x);
  }
};
template <class Matrix>
struct derivative_entries {
  entries_of<Matrix> by_q, by_v, by_a;
};
/// Writes the derivatives of the forces on joints of a tree of joints to matrices of zeros. `pass`: its motion and
/// forces.
template <class S, class Pass, class Result>
KTE_INLINE void write_force_derivatives(const Pass& pass, Result& r) {
  using bodies_type = moving_bodies<S, Pass, axes_of_dofs<typename Pass::chain_type>>;
  const bodies_type bodies(pass);
  const derivative_entries<decltype(r.by_q)> put{{r.by_q}, {r.by_v}, {r.by_a}};
  derivatives_of_forces(engine::unrolled<bodies_type>{bodies}, put);
}

}  // namespace kte::detail
