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
inline constexpr struct seat1_ final : kte::frame_2D_key<"seat1"> {} seat1;
inline constexpr struct seat2_ final : kte::frame_2D_key<"seat2"> {} seat2;
inline constexpr struct seat3_ final : kte::frame_2D_key<"seat3"> {} seat3;
inline constexpr struct seat4_ final : kte::frame_2D_key<"seat4"> {} seat4;
inline constexpr struct seat5_ final : kte::frame_2D_key<"seat5"> {} seat5;
inline constexpr struct seat6_ final : kte::frame_2D_key<"seat6"> {} seat6;
inline constexpr struct seat7_ final : kte::frame_2D_key<"seat7"> {} seat7;
inline constexpr struct seat8_ final : kte::frame_2D_key<"seat8"> {} seat8;
inline constexpr struct seat9_ final : kte::frame_2D_key<"seat9"> {} seat9;
inline constexpr struct seat10_ final : kte::frame_2D_key<"seat10"> {} seat10;
inline constexpr struct seat11_ final : kte::frame_2D_key<"seat11"> {} seat11;
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
    return chain(revolute_joint_2D(q1, seat1, rod1), inertia_2D(rod1, rod), rigid_link_2D(rod1, seat2, along_x(1.0)),
                 revolute_joint_2D(q2, seat2, rod2), inertia_2D(rod2, rod), rigid_link_2D(rod2, seat3, along_x(1.0)),
                 revolute_joint_2D(q3, seat3, rod3), inertia_2D(rod3, rod), rigid_link_2D(rod3, seat4, along_x(1.0)),
                 revolute_joint_2D(q4, seat4, rod4), inertia_2D(rod4, rod), rigid_link_2D(rod4, seat5, along_x(1.0)),
                 revolute_joint_2D(q5, seat5, rod5), inertia_2D(rod5, rod), rigid_link_2D(rod5, seat6, along_x(1.0)),
                 revolute_joint_2D(q6, seat6, rod6), inertia_2D(rod6, rod), rigid_link_2D(rod6, seat7, along_x(1.0)),
                 revolute_joint_2D(q7, seat7, rod7), inertia_2D(rod7, rod), rigid_link_2D(rod7, seat8, along_x(1.0)),
                 revolute_joint_2D(q8, seat8, rod8), inertia_2D(rod8, rod), rigid_link_2D(rod8, seat9, along_x(1.0)),
                 revolute_joint_2D(q9, seat9, rod9), inertia_2D(rod9, rod), rigid_link_2D(rod9, seat10, along_x(1.0)),
                 revolute_joint_2D(q10, seat10, rod10), inertia_2D(rod10, rod),
                 rigid_link_2D(rod10, seat11, along_x(1.0)))
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
    const auto tip = forward_kinematics(model, q, ten_rods_names::seat11).position;
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
