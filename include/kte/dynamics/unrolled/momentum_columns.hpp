#pragma once

#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/detail/columns.hpp>

namespace kte::detail {

/// The momentum that the unit rate of each axis of a joint makes, in axes of the bases and about a point, as a column:
/// (2) of `centroidal_momentum_matrix`.
template <class S, class Chain, class Given>
class momentum_columns : columns<S, Chain, Given> {
  using base = columns<S, Chain, Given>;
  using motion_type = local_motion<Chain, Given>;
  using bodies_type = typed_bodies<S, motion_type, axes_of_joints<Chain>>;
  static_assert(sizeof(passed_over<Chain>) > 0);

 public:
  using typename base::matrix_type;

  KTE_INLINE momentum_columns(const Chain& c, const Given& g, const vec3<S>& point, matrix_type& m) : base(c, g, m) {
    const motion_type motion(c, g);
    const bodies_type bodies{motion};
    const engine::unrolled<bodies_type> d{bodies};
    (void)sum_over_grounds(motion, [&]<class Frame>(const auto&) KTE_INLINE_LAMBDA {
      (void)engine::composite_inertia_of<Frame>(d, [&]<class B>(const B& b, const auto& inertia) KTE_INLINE_LAMBDA {
        const auto& x = motion.template get<B::end::what, B::end::slot>();
        for_each_number<B::axes>([&]<int N>() KTE_INLINE_LAMBDA {
          const auto s = b.template axis<N>();
          const auto h =
              transmit(pose{x.rotation, x.position - point}, accelerating_wrench(inertia, s.linear, s.angular));
          this->template put<B::element, N>(h.force, h.torque);
        });
      });
      return no_mass;
    });
  }
};

}  // namespace kte::detail
