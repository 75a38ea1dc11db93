#pragma once

#include "data/problems/mechanism.hpp"

namespace kte::problems {

namespace flyball_governor_names {
// clang-format off
inline constexpr struct turn_ final : kte::coord_key<"turn"> {} turn;
inline constexpr struct height_ final : kte::coord_key<"height"> {} height;
inline constexpr struct fall1_ final : kte::coord_key<"fall1"> {} fall1;
inline constexpr struct fall2_ final : kte::coord_key<"fall2"> {} fall2;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct shaft_ final : kte::frame_3D_key<"shaft"> {} shaft;
inline constexpr struct slider_ final : kte::frame_3D_key<"slider"> {} slider;
inline constexpr struct hinge1_ final : kte::frame_3D_key<"hinge1"> {} hinge1;
inline constexpr struct rod1_ final : kte::frame_3D_key<"rod1"> {} rod1;
inline constexpr struct middle1_ final : kte::frame_3D_key<"middle1"> {} middle1;
inline constexpr struct end1_ final : kte::frame_3D_key<"end1"> {} end1;
inline constexpr struct side1_ final : kte::frame_3D_key<"side1"> {} side1;
inline constexpr struct hinge2_ final : kte::frame_3D_key<"hinge2"> {} hinge2;
inline constexpr struct rod2_ final : kte::frame_3D_key<"rod2"> {} rod2;
inline constexpr struct middle2_ final : kte::frame_3D_key<"middle2"> {} middle2;
inline constexpr struct end2_ final : kte::frame_3D_key<"end2"> {} end2;
inline constexpr struct side2_ final : kte::frame_3D_key<"side2"> {} side2;
// clang-format on
}  // namespace flyball_governor_names

/// A governor that a spring makes stiff: a shaft, free to turn about z at 2 pi rad/s, two rods of 1 m on hinges 1 m
/// high and 0.05 m aside, with 5 kg at their ends, 30 degrees below the horizontal, and a slider on the shaft, 0.5 m
/// high. A spring of 8e5 N/m and 0.5 m and a damper of 4e4 N s/m connect the middle of each rod to the slider, 0.05 m
/// aside of the shaft.
///
/// Shaft and rods are bars of 1 x 0.01 x 0.01 m, the slider a cube of 0.1 m, of 3000 kg/m^3; how high the shaft
/// stands is of no matter, its centre is at 0 here. q: the angle of the shaft, the height s of the slider, and the
/// angles of the rods below the horizontal, which stay equal.
///
/// The fastest rate is 8.1e3 1/s, the motion takes a second. Problem A05 of the IFToMM library of multibody benchmarks.
struct flyball_governor {
  static constexpr const char* name = "flyball governor";
  static constexpr long double t_end = 10L;
  static constexpr auto model = [] {
    using namespace flyball_governor_names;
    constexpr double along = 0.3 * (0.01 * 0.01 + 0.01 * 0.01) / 12, across = 0.3 * (1 + 0.01 * 0.01) / 12;
    constexpr rigid_body rod{0.3, along_x(0.5), diagonal(along, across, across)};
    return chain(revolute_joint_3D(turn, base, shaft),
                 inertia_3D(shaft, rigid_body{0.3, vec3{zero, zero, zero}, diagonal(across, across, along)}),
                 prismatic_joint_3D(height, shaft, slider, axis::z),
                 inertia_3D(slider, rigid_body{3.0, vec3{zero, zero, zero}, diagonal(0.005, 0.005, 0.005)}),

                 rigid_link_3D(shaft, hinge1, vec3{0.05, zero, 1.0}), revolute_joint_3D(fall1, hinge1, rod1, axis::y),
                 inertia_3D(rod1, rod), rigid_link_3D(rod1, middle1, along_x(0.5)),
                 rigid_link_3D(rod1, end1, along_x(1.0)), inertia_3D(end1, point_mass(5.0)),
                 rigid_link_3D(slider, side1, along_x(0.05)),

                 rigid_link_3D(shaft, hinge2, vec3{-0.05, zero, 1.0}, half_turn_z),
                 revolute_joint_3D(fall2, hinge2, rod2, axis::y), inertia_3D(rod2, rod),
                 rigid_link_3D(rod2, middle2, along_x(0.5)), rigid_link_3D(rod2, end2, along_x(1.0)),
                 inertia_3D(end2, point_mass(5.0)), rigid_link_3D(slider, side2, along_x(-0.05)),

                 spring_3D(middle1, side1, 0.5, 8e5), damper_3D(middle1, side1, 4e4),
                 spring_3D(middle2, side2, 0.5, 8e5), damper_3D(middle2, side2, 4e4))
        .gravity(along_z(-9.81));
  }();

  template <class S>
  static joint_vector<S, 4> start_q() {
    using std::asin;
    const S below = asin(S(0.5));
    return {S(0), S(0.5), below, below};
  }
  template <class S>
  static joint_vector<S, 4> start_v() {
    using std::acos;
    return {S(4 * acos(S(0))), S(0), S(0), S(0)};
  }
  /// s, angle of a rod, angle of the shaft; their rates; length of a spring; energy.
  template <class S>
  static Eigen::Matrix<S, 8, 1> output(const joint_vector<S, 4>& q, const joint_vector<S, 4>& v) {
    using namespace flyball_governor_names;
    const auto e = energy(model, q, v);
    const auto spring = to_eigen<S>(
        as<S>(forward_kinematics(model, q, middle1).position - forward_kinematics(model, q, side1).position));
    Eigen::Matrix<S, 8, 1> r;
    r << q[1], q[2], q[0], v[1], v[2], v[0], spring.norm(), S(e.kinetic + e.potential);
    return r;
  }

  /// Integrated twice at 50 digits, by Radau IIA of orders 17 and 21; only digits on which both agree.
  static constexpr known<8> references[]{
      {0.1L,
       {0.5238364755695756942751681264L, 0.4961738690759002561264918579L, 0.6221066814026875710193453347L,
        0.45927181043613388345861030L, -0.52267392975398021771158071L, 6.103717808830862763474344286L,
        0.50004724872629418997026932774L, 237.4115679856156554259349816L}},
      {0.5L,
       {0.74324942478632572138775253L, 0.25949138154341312162132867L, 2.80767948836790160105373693L,
        0.0521197801583734170431642L, -0.0539052184987424724519315L, 5.10341542197153529777702367L,
        0.50004148412222651903671368199L, 237.411518921963598179805083L}},
      {1.0L,
       {0.50142092237956765074719399936L, 0.52183330162554623104678472699L, 5.58634696586900543151380268L,
        -0.122151492897728913228099937L, 0.140885579479526918733954896L, 6.2711257418765547961323868582L,
        0.50005424313973348984951860308L, 237.41148170166827447158307940L}},
      {10.0L,
       {0.619622917061365658822847779L, 0.390073701844645080543963048L, 55.9354099091023787684733243L,
        -0.747603354164332467685330L, 0.8084670513455774002664151L, 5.54820362265492658250292023L,
        0.50004583384908518978938347416L, 237.4108285808226247129875949L}}};
};

}  // namespace kte::problems
