#pragma once

#include "data/problems/mechanism.hpp"

namespace kte::problems {

namespace ten_rods_names {
// clang-format off
inline constexpr struct q1_ final : kte::coord_key<"q1"> {} q1;
inline constexpr struct q2_ final : kte::coord_key<"q2"> {} q2;
inline constexpr struct q3_ final : kte::coord_key<"q3"> {} q3;
inline constexpr struct q4_ final : kte::coord_key<"q4"> {} q4;
inline constexpr struct q5_ final : kte::coord_key<"q5"> {} q5;
inline constexpr struct q6_ final : kte::coord_key<"q6"> {} q6;
inline constexpr struct q7_ final : kte::coord_key<"q7"> {} q7;
inline constexpr struct q8_ final : kte::coord_key<"q8"> {} q8;
inline constexpr struct q9_ final : kte::coord_key<"q9"> {} q9;
inline constexpr struct q10_ final : kte::coord_key<"q10"> {} q10;
inline constexpr struct mount1_ final : kte::frame_2D_key<"mount1"> {} mount1;
inline constexpr struct mount2_ final : kte::frame_2D_key<"mount2"> {} mount2;
inline constexpr struct mount3_ final : kte::frame_2D_key<"mount3"> {} mount3;
inline constexpr struct mount4_ final : kte::frame_2D_key<"mount4"> {} mount4;
inline constexpr struct mount5_ final : kte::frame_2D_key<"mount5"> {} mount5;
inline constexpr struct mount6_ final : kte::frame_2D_key<"mount6"> {} mount6;
inline constexpr struct mount7_ final : kte::frame_2D_key<"mount7"> {} mount7;
inline constexpr struct mount8_ final : kte::frame_2D_key<"mount8"> {} mount8;
inline constexpr struct mount9_ final : kte::frame_2D_key<"mount9"> {} mount9;
inline constexpr struct mount10_ final : kte::frame_2D_key<"mount10"> {} mount10;
inline constexpr struct mount11_ final : kte::frame_2D_key<"mount11"> {} mount11;
inline constexpr struct rod1_ final : kte::frame_2D_key<"rod1"> {} rod1;
inline constexpr struct rod2_ final : kte::frame_2D_key<"rod2"> {} rod2;
inline constexpr struct rod3_ final : kte::frame_2D_key<"rod3"> {} rod3;
inline constexpr struct rod4_ final : kte::frame_2D_key<"rod4"> {} rod4;
inline constexpr struct rod5_ final : kte::frame_2D_key<"rod5"> {} rod5;
inline constexpr struct rod6_ final : kte::frame_2D_key<"rod6"> {} rod6;
inline constexpr struct rod7_ final : kte::frame_2D_key<"rod7"> {} rod7;
inline constexpr struct rod8_ final : kte::frame_2D_key<"rod8"> {} rod8;
inline constexpr struct rod9_ final : kte::frame_2D_key<"rod9"> {} rod9;
inline constexpr struct rod10_ final : kte::frame_2D_key<"rod10"> {} rod10;
// clang-format on
}  // namespace ten_rods_names

/// Ten uniform rods of 1 kg and 1 m in the plane, released at rest, straight and horizontal: a whip. The outer rods
/// fall freely at first. q: the angle of the first rod from hanging, and of each from the one before.
struct ten_rods {
  static constexpr const char* name = "ten rods";
  static constexpr long double t_end = 1L;
  static constexpr auto model = [] {
    using namespace ten_rods_names;
    constexpr auto rod = planar_body(1.0, 1.0 / 12, along_x(0.5));
    return chain(revolute_joint_2D(q1, mount1, rod1), inertia_2D(rod1, rod), rigid_link_2D(rod1, mount2, along_x(1.0)),
                 revolute_joint_2D(q2, mount2, rod2), inertia_2D(rod2, rod), rigid_link_2D(rod2, mount3, along_x(1.0)),
                 revolute_joint_2D(q3, mount3, rod3), inertia_2D(rod3, rod), rigid_link_2D(rod3, mount4, along_x(1.0)),
                 revolute_joint_2D(q4, mount4, rod4), inertia_2D(rod4, rod), rigid_link_2D(rod4, mount5, along_x(1.0)),
                 revolute_joint_2D(q5, mount5, rod5), inertia_2D(rod5, rod), rigid_link_2D(rod5, mount6, along_x(1.0)),
                 revolute_joint_2D(q6, mount6, rod6), inertia_2D(rod6, rod), rigid_link_2D(rod6, mount7, along_x(1.0)),
                 revolute_joint_2D(q7, mount7, rod7), inertia_2D(rod7, rod), rigid_link_2D(rod7, mount8, along_x(1.0)),
                 revolute_joint_2D(q8, mount8, rod8), inertia_2D(rod8, rod), rigid_link_2D(rod8, mount9, along_x(1.0)),
                 revolute_joint_2D(q9, mount9, rod9), inertia_2D(rod9, rod), rigid_link_2D(rod9, mount10, along_x(1.0)),
                 revolute_joint_2D(q10, mount10, rod10), inertia_2D(rod10, rod),
                 rigid_link_2D(rod10, mount11, along_x(1.0)))
        .gravity(along_x(9.81));
  }();

  template <class S>
  static joint_vector<S, 10> start_q() {
    using std::acos;
    joint_vector<S, 10> q = joint_vector<S, 10>::Zero();
    q[0] = acos(S(0));
    return q;
  }
  template <class S>
  static joint_vector<S, 10> start_v() {
    return joint_vector<S, 10>::Zero();
  }
  /// All angles from hanging, and the tip: how far out, how high, m.
  template <class S>
  static Eigen::Matrix<S, 12, 1> output(const joint_vector<S, 10>& q, const joint_vector<S, 10>&) {
    Eigen::Matrix<S, 12, 1> r;
    S angle(0);
    for (int i = 0; i < 10; ++i) r[i] = angle += q[i];
    const auto tip = forward_kinematics(model, q, ten_rods_names::mount11).position;
    r[10] = tip.y, r[11] = -tip.x;
    return r;
  }

  /// Integrated twice at 60 digits, by extrapolation of different orders; only digits on which both agree.
  static constexpr known<12> references[]{
      {0.5L,
       {0.931491509115329633926210836155L, 1.09620519893771138510510302766L, 1.35278944412622712636422412654L,
        1.60967199888709763465862215062L, 1.58142675973095813570980163567L, 1.56258520631743307125239559703L,
        1.57388463130524205799164717430L, 1.56986863052419742207876020518L, 1.57105402032006365345417899226L,
        1.57071141265907265806638117038L, 9.66746981860058168446265921472L, -1.22627814109644654200110501463L}},
      {1.0L,
       {0.483090712777086842157383903389L, 0.531379568903647666144899024309L, 0.558414720201518112027385350193L,
        0.656039229489780855517402458228L, 0.722851352592796451614505995989L, 0.944524644711800960910270307642L,
        1.26699338290158917952873473575L, 1.70941078288452163306473800237L, 1.55102793543246314762110462245L,
        1.56951475519991553742398493439L, 7.52722901556035570735839828554L, -4.90626231971500372627363385601L}}};
};

}  // namespace kte::problems
