#pragma once

#include <kte/contract/element_numbers.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <vector>

namespace kte::detail {

/// The order of rows and columns of `mass_matrix_calc`.
constexpr int order_of(kind k) {
  constexpr kind in_order[]{kind::gen, kind::frame_2D, kind::pose_2D, kind::frame_3D, kind::pose_3D};
  return static_cast<int>(std::find(std::begin(in_order), std::end(in_order), k) - std::begin(in_order));
}
template <class X>
void insert_by_kind(std::vector<X>& all, X x) {
  const auto later = [](const X& a, const X& b) { return order_of(a.what) < order_of(b.what); };
  all.insert(std::upper_bound(all.begin(), all.end(), x, later), std::move(x));
}
/// The mass block of a body of mass m, first moment h and inertia I
///
///   ( m 1  -[h]x )
///   ( [h]x    I  )          (1)
template <class S>
Eigen::Matrix<S, 6, 6> mass_block(const S& m, const vec3<S>& h, const sym3<S>& i) {
  const S o(0);
  Eigen::Matrix<S, 6, 6> b;
  b << m, o, o, o, h.z, -h.y,          //
      o, m, o, -h.z, o, h.x,           //
      o, o, m, h.y, -h.x, o,           //
      o, -h.z, h.y, i.xx, i.xy, i.xz,  //
      h.z, o, -h.x, i.xy, i.yy, i.yz,  //
      -h.y, h.x, o, i.xz, i.yz, i.zz;  // (1)
  return b;
}
/// The rows, out of six, of a frame of kind K.
template <kind K>
constexpr auto rows_in_space() {
  if constexpr (K == kind::frame_2D)
    return std::array{0, 1, 5};
  else
    return std::array{0, 1, 2, 3, 4, 5};
}
/// The mass of an element on a coordinate or frame.
inline Eigen::MatrixXd mass_block(const element_numbers<double>& n, kind k) {
  if (k == kind::gen) return Eigen::MatrixXd::Constant(1, 1, n.mass);
  const Eigen::Matrix<double, 6, 6> b = mass_block(n.weight.mass, n.weight.moment, n.weight.inertia);
  if (k == kind::frame_3D) return b;
  constexpr auto in_plane = rows_in_space<kind::frame_2D>();
  return b(in_plane, in_plane);
}

}  // namespace kte::detail
