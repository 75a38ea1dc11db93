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
inline int order_of(kind k) {
  constexpr kind in_order[]{kind::gen, kind::frame_2D, kind::pose_2D, kind::frame_3D, kind::pose_3D};
  return static_cast<int>(std::find(std::begin(in_order), std::end(in_order), k) - std::begin(in_order));
}
template <class X>
void insert_by_kind(std::vector<X>& all, X x) {
  const auto later = [](const X& a, const X& b) { return order_of(a.what) < order_of(b.what); };
  all.insert(std::upper_bound(all.begin(), all.end(), x, later), std::move(x));
}
/// The mass of an element on a coordinate or frame: of a body of mass m, first moment h and inertia I
///
///   ( m 1  -[h]x )
///   ( [h]x    I  )          (1)
inline Eigen::MatrixXd mass_block(const element_numbers<double>& n, kind k) {
  if (k == kind::gen) return Eigen::MatrixXd::Constant(1, 1, n.mass);
  const auto& [m, h, i] = n.weight;
  Eigen::MatrixXd b(6, 6);
  b << m, 0, 0, 0, h.z, -h.y,          //
      0, m, 0, -h.z, 0, h.x,           //
      0, 0, m, h.y, -h.x, 0,           //
      0, -h.z, h.y, i.xx, i.xy, i.xz,  //
      h.z, 0, -h.x, i.xy, i.yy, i.yz,  //
      -h.y, h.x, 0, i.xz, i.yz, i.zz;  // (1)
  if (k == kind::frame_3D) return b;
  constexpr std::array in_plane{0, 1, 5};
  return b(in_plane, in_plane);
}

}  // namespace kte::detail
