#pragma once

#include "data/problems/mechanism.hpp"

namespace kte::problems {

namespace heavy_top_names {
// clang-format off
inline constexpr struct turn_ final : kte::rotation_3D_key<"turn"> {} turn;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct body_ final : kte::frame_3D_key<"body"> {} body;
inline constexpr struct centre_ final : kte::frame_3D_key<"centre"> {} centre;
// clang-format on
}  // namespace heavy_top_names

/// A fast heavy top, the standard example of integrators on rotations: 15 kg, the centre of mass at (0, 1, 0) from the
/// fixed point, inertia about it (0.234375, 0.46875, 0.234375) kg m^2, gravity -z, w = (0, 150, -4.61538) rad/s at the
/// start, where body and world axes are the same.
///
/// The energy is 5435.696790865546875 J, w_y and the angular momentum about z, -70.3124296875, are constant.
/// Bruels and Cardona, On the use of Lie group time integrators in multibody dynamics, J. Comp. Nonlin. Dyn. 5 (2010).
struct heavy_top {
  static constexpr const char* name = "heavy top";
  static constexpr long double t_end = 2L;
  static constexpr auto model = [] {
    using namespace heavy_top_names;
    return chain(spherical_joint_3D(turn, base, body), rigid_link_3D(body, centre, along_y(1.0)),
                 inertia_3D(centre, rigid_body{15.0, vec3{zero, zero, zero}, diagonal(0.234375, 0.46875, 0.234375)}))
        .gravity(along_z(-9.81));
  }();

  template <class S>
  static joint_vector<S, 4> start_q() {
    return {S(1), S(0), S(0), S(0)};
  }
  template <class S>
  static joint_vector<S, 3> start_v() {
    return {S(0), S(150), S(S(-461538) / S(100000))};
  }
  /// The rates in axes of the body, and the centre of mass, m.
  template <class S>
  static Eigen::Matrix<S, 6, 1> output(const joint_vector<S, 4>& q, const joint_vector<S, 3>& v) {
    Eigen::Matrix<S, 6, 1> r;
    r << v, to_eigen<S>(forward_kinematics(model, q, heavy_top_names::centre).position);
    return r;
  }

  /// Integrated twice at 60 digits; only digits on which both agree.
  static constexpr known<6> references[]{
      {0.1L,
       {4.80894133172809231184659725302L, 150.000000000000000000000000000L, 1.02830075671832984154221053179L,
        0.421296658925402043647310429057L, 0.894571974345592990891180471457L, -0.149164700561899611618320798218L}},
      {1.0L,
       {-0.822078101682704456256289381739L, 150.000000000000000000000000000L, -5.92329134811733618607686086848L,
        0.173343964098386042591966115121L, 0.640088592070568782860591998040L, -0.748490791133581309483597679122L}},
      {2.0L,
       {0.122233219497394236787281516379L, 150.000000000000000000000000000L, -5.85562458920545772829141025166L,
        -0.150416822745641759810030830722L, -0.724165591636895650748554397096L, -0.673022269560444096050221046988L}}};
};

}  // namespace kte::problems
