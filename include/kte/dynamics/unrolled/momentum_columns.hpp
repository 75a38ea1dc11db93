#pragma once

#include <kte/detail/unroll.hpp>
#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/unrolled/columns.hpp>

namespace kte::detail {

/// The momentum of the unit rate of each joint axis, in axes of the bases and about a point, as a column: (2) of
/// `centroidal_momentum_matrix`. With three rows only the linear rows, which do not depend on the point.
template <class S, class Chain, class Given, int Rows = 6>
class momentum_columns : columns<S, Chain, Given, Rows> {
  using base = columns<S, Chain, Given, Rows>;
  using motion_type = unrolled_motion<Chain, Given>;
  using bodies_type = typed_bodies<S, motion_type, axes_of_joints<Chain>>;
  static_assert(sizeof(passed_over<Chain>) > 0);

 public:
  using typename base::matrix_type;

  KTE_INLINE momentum_columns(const Chain& c, const Given& g, const vec3<S>& point, matrix_type& m)
      : base(c, g, m), motion_(c, g), point_(point) {}
  /// Fills the matrix. Returns the composite inertia of all bodies, about the origin of the bases.
  KTE_INLINE auto fill() {
    const bodies_type bodies(motion_);
    const engine::unrolled<bodies_type> d{bodies};
    return sum_over_grounds(motion_, [&]<class Frame>(const auto& ground) KTE_INLINE_LAMBDA {
      return transported(ground.rotation, ground.position,
                         engine::composite_inertia_of<Frame>(
                             d, [this](const auto& b, const auto& inertia, const auto& place) KTE_INLINE_LAMBDA {
                               this->template put<std::remove_cvref_t<decltype(place)>::number>(b, inertia);
                               return engine::fresh(inertia);
                             }));
    });
  }

 private:
  template <std::size_t I, class B, class C>
  KTE_INLINE constexpr void put(const B& b, const C& inertia) {
    using frame = typename bodies_type::template end<I>;
    const auto& x = motion_.template get<frame::what, frame::slot>();
    unroll<B::axes>([&]<int N>() KTE_INLINE_LAMBDA {
      const auto s = b.template axis<N>();
      const auto w = accelerating_wrench(inertia, s.linear, s.angular);
      if constexpr (Rows == 3) {
        base::template put<I, N>(x.rotation * w.force, zero3{});
      } else {
        const auto h = transmit(pose{x.rotation, x.position - point_}, w);
        base::template put<I, N>(h.force, h.torque);
      }
    });
  }
  const motion_type motion_;
  const vec3<S> point_;
};

}  // namespace kte::detail
