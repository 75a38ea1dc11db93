#pragma once

#include "data/problems/mechanism.hpp"

namespace kte::problems {

namespace double_pendulum_names {
// clang-format off
inline constexpr struct q1_ final : kte::coord_key<"q1"> {} q1;
inline constexpr struct q2_ final : kte::coord_key<"q2"> {} q2;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {} base;
inline constexpr struct rod1_ final : kte::frame_2D_key<"rod1"> {} rod1;
inline constexpr struct bob1_ final : kte::frame_2D_key<"bob1"> {} bob1;
inline constexpr struct rod2_ final : kte::frame_2D_key<"rod2"> {} rod2;
inline constexpr struct bob2_ final : kte::frame_2D_key<"bob2"> {} bob2;
// clang-format on
}  // namespace double_pendulum_names

/// Two masses of 1 kg on massless rods of 1 m in the plane, at rest at the start. q: the angle of the first rod from
/// hanging, and that of the second from the first.
struct double_pendulum {
  static constexpr long double t_end = 10;
  static constexpr auto model = [] {
    using namespace double_pendulum_names;
    return chain(revolute_joint_2D(q1, base, rod1), rigid_link_2D(rod1, bob1, along_x(1.0)),
                 inertia_2D(bob1, point_mass(1.0)), revolute_joint_2D(q2, bob1, rod2),
                 rigid_link_2D(rod2, bob2, along_x(1.0)), inertia_2D(bob2, point_mass(1.0)))
        .gravity(along_x(9.81));
  }();

  template <class S>
  static joint_vector<S, 2> start_v() {
    return joint_vector<S, 2>::Zero();
  }
  /// Both angles from hanging, and their rates.
  template <class S>
  static Eigen::Matrix<S, 4, 1> output(const joint_vector<S, 2>& q, const joint_vector<S, 2>& v) {
    return {q[0], S(q[0] + q[1]), v[0], S(v[0] + v[1])};
  }
};

/// Released straight and horizontal; energy 0.
struct double_pendulum_from_horizontal : double_pendulum {
  static constexpr const char* name = "double pendulum from horizontal";
  template <class S>
  static joint_vector<S, 2> start_q() {
    using std::acos;
    return {acos(S(0)), S(0)};
  }
  /// Integrated twice at 60 digits, by extrapolation of different orders; only digits on which both agree.
  static constexpr known<4> references[]{{1.0L,
                                          {-0.625087699806390629954126671518L, -1.03458508568001234061226392300L,
                                           -3.92227957288797661687347975153L, -1.30309924869633124332279708070L}},
                                         {5.0L,
                                          {-0.627186705066530730138131579354L, -1.30131555020981167790753211465L,
                                           2.12540867384291065065138311453L, 3.88188872726560743925483424302L}},
                                         {10.0L,
                                          {-0.568474664015950188776113708263L, -0.526393727932404698329554193050L,
                                           6.07838488576196485482499728652L, -9.68136068170887875807683852677L}}};
};

/// Released straight at 2 rad from hanging: it turns over, and is chaotic.
struct double_pendulum_from_2_rad : double_pendulum {
  static constexpr const char* name = "double pendulum from 2 rad";
  template <class S>
  static joint_vector<S, 2> start_q() {
    return {S(2), S(0)};
  }
  /// Integrated twice at 60 digits, by extrapolation of different orders; only digits on which both agree.
  static constexpr known<4> references[]{{1.0L,
                                          {-0.406686941243859212042417655408L, -0.966527041829631449504763587189L,
                                           -5.09904426418888872973088686135L, -1.87198852804481363982338276238L}},
                                         {5.0L,
                                          {-1.41070668894158425508910461502L, -4.04171687887718968756607735879L,
                                           -1.98414730603406482561634651109L, -5.42952562540806422617141412236L}},
                                         {10.0L,
                                          {-0.60216261066585398743018839365L, -10.5014745157145198651321789663L,
                                           -6.24216709501984652153316805080L, -4.8979696631631120787536582618L}}};
};

}  // namespace kte::problems
