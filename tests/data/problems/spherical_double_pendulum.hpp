#pragma once

#include "data/problems/mechanism.hpp"

namespace kte::problems {

namespace spherical_double_pendulum_names {
// clang-format off
inline constexpr struct ball1_ final : kte::rotation_3D_key<"ball1"> {} ball1;
inline constexpr struct ball2_ final : kte::rotation_3D_key<"ball2"> {} ball2;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct rod1_ final : kte::frame_3D_key<"rod1"> {} rod1;
inline constexpr struct end1_ final : kte::frame_3D_key<"end1"> {} end1;
inline constexpr struct rod2_ final : kte::frame_3D_key<"rod2"> {} rod2;
inline constexpr struct end2_ final : kte::frame_3D_key<"end2"> {} end2;
// clang-format on
}  // namespace spherical_double_pendulum_names

/// Two masses of 1 kg on massless rods of 1 m on ball joints, z up, with energy 0.75 J and the angular momentum 1 about
/// z. At the start the masses are at (1, 0, 0) and (1, 1, 0), with velocities (0, 0.5, 0) and (0, 0.5, 1).
///
/// Thin rods have no inertia about themselves, so ball joints would leave their own turns undetermined. These bodies do
/// not turn about themselves either, and otherwise move alike, because two moments agree for both rods with the mass at
/// joint 2 shared half and half, each over the distance r from the joint before:
///
///   int r dm = 1/2 and 1,   int r^2 dm = 1/2 and 1          (1)
///
/// namely m = 1, c = 1/2, I = 1/4, and m = 3/2, c = 2/3, I = 1/3 about any axis through c; I is free along the rod.
struct spherical_double_pendulum {
  static constexpr const char* name = "spherical double pendulum";
  static constexpr long double t_end = 10L;
  static constexpr auto model = [] {
    using namespace spherical_double_pendulum_names;
    return chain(spherical_joint_3D(ball1, base, rod1),
                 inertia_3D(rod1, rigid_body{1.0, along_x(0.5), diagonal(0.25, 0.25, 0.25)}),
                 rigid_link_3D(rod1, end1, along_x(1.0)), spherical_joint_3D(ball2, end1, rod2),
                 inertia_3D(rod2, rigid_body{1.5, along_y(2.0 / 3), diagonal(1.0 / 3, 1.0 / 3, 1.0 / 3)}),  // (1)
                 rigid_link_3D(rod2, end2, along_y(1.0)))
        .gravity(along_z(-9.81));
  }();

  template <class S>
  static joint_vector<S, 8> start_q() {
    joint_vector<S, 8> q = joint_vector<S, 8>::Zero();
    q[0] = q[4] = 1;
    return q;
  }
  template <class S>
  static joint_vector<S, 6> start_v() {
    joint_vector<S, 6> v = joint_vector<S, 6>::Zero();
    v[2] = S(0.5), v[3] = 1, v[5] = -S(0.5);
    return v;
  }
  /// Position and velocity of the first mass, then of the second, in axes of the base.
  template <class S>
  static Eigen::Matrix<S, 12, 1> output(const joint_vector<S, 8>& q, const joint_vector<S, 6>& v) {
    using namespace spherical_double_pendulum_names;
    Eigen::Matrix<S, 12, 1> r;
    r << motion_of(q, v, end1), motion_of(q, v, end2);
    return r;
  }

  /// Integrated twice at 60 digits as points; only digits on which both agree.
  static constexpr known<12> references[]{
      {1.0L,
       {-0.0753593266891094411291721868769L, -0.360225048638576917843869065011L, -0.929816587405440391515355929164L,
        -2.45186335016244988260890123972L, -3.96372249126763534917622780566L, 1.73432365076262804161376231437L,
        -0.959983234171732882457043084348L, -0.281329517534497930971680761186L, -1.38939904734269712159962194652L,
        -2.87184593852298669887777163473L, -2.49218328362294462353083438932L, 2.79534000413768792655194758225L}},
      {5.0L,
       {-0.0625733585160492679725033713861L, -0.269192660861474941026605016189L, -0.961051448228626781051232144136L,
        -4.15603418013865464539851468891L, 1.38233636233267679919142049107L, -0.116599155050101538505314540696L,
        0.321998740994548100798972481881L, 0.610704502428678321518062618071L, -1.24013079592736381687661427326L,
        -3.58766864976496383305022936481L, 0.044304305957947811784826430194L, -3.55201310952556127105607199466L}},
      {10.0L,
       {-0.0477997844952782927241984806620L, -0.70833248544748473880339908181L, -0.70425866743831685245397842162L,
        1.4681972881926842316281755227L, 1.4721708535104360905431985230L, -1.5803368919702143614944813000L,
        0.55048955904613948887607740437L, -0.41089225493945511645962580366L, 0.03977034454986467918960874457L,
        2.1294543838638278809329587701L, -1.5342320021013875572671494467L, -0.910198931409200242937107867127L}}};

 private:
  template <class Q, class V, class Frame>
  static auto motion_of(const Q& q, const V& v, const Frame& frame) {
    using S = value_of<Q>;
    const auto at = forward_kinematics(model, q, frame);
    Eigen::Matrix<S, 6, 1> r;
    r << to_eigen<S>(at.position), to_eigen<S>(as<S>(at.rotation * frame_velocity(model, q, v, frame).linear));
    return r;
  }
};

}  // namespace kte::problems
