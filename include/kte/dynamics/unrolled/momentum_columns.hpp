#pragma once

#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/unrolled/columns.hpp>

namespace kte::detail {

/// The momentum of the unit rate of each joint axis, in axes of the bases and about a point, as a column: (2) of
/// `centroidal_momentum_matrix`. With three rows only the linear rows, which do not depend on the point.
template <class S, class Chain, class Given, int Rows = 6>
class momentum_columns : columns<S, Chain, Given, Rows> {
  using base = columns<S, Chain, Given, Rows>;
  using motion_type = unrolled_motion<Chain, Given>;

 public:
  using typename base::matrix_type;

  KTE_INLINE momentum_columns(const Chain& c, const Given& g, const vec3<S>& point, matrix_type& m)
      : base(c, g, m), motion_(c, g), point_(point) {}
  /// Fills the matrix. Returns the composite inertia of all bodies, about the origin of the bases.
  KTE_INLINE auto fill() {
    return composite_inertia_at_base<S>(
        motion_, engine::momenta_of_axes{
                     poses_from(motion_, point_),
                     [this]<class Place, int K, class H>(const Place&, std::integral_constant<int, K>, const H& h)
                         KTE_INLINE_LAMBDA { this->template put<Place::number, K>(h.force, h.torque); }});
  }

 private:
  const motion_type motion_;
  const vec3<S> point_;
};

}  // namespace kte::detail
