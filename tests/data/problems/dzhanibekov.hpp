#pragma once

#include "data/problems/mechanism.hpp"

namespace kte::problems {

namespace dzhanibekov_names {
// clang-format off
inline constexpr struct turn_ final : kte::rotation_3D_key<"turn"> {} turn;
inline constexpr struct base_ final : kte::frame_3D_key<"base"> {} base;
inline constexpr struct body_ final : kte::frame_3D_key<"body"> {} body;
// clang-format on
}  // namespace dzhanibekov_names

/// The effect of Dzhanibekov: a free body turns about its middle axis, and flips every 2.7530840553733186 s.
/// I = (1, 2, 3) kg m^2, w = (0.01, 10, 0.01) rad/s, axes those of the world at the start. With Jacobi's functions
///
///   w = (A_1 cn, A_2 sn, A_3 dn)(n t + u_0),   n = 5.77351135214380031,  k^2 = 0.999998000005999982
///
/// The kinetic energy is 100.0002 J and the momentum in world axes (0.01, 20, 0.03), both constant.
struct dzhanibekov {
  static constexpr const char* name = "Dzhanibekov";
  static constexpr long double t_end = 100L;
  static constexpr auto model = [] {
    using namespace dzhanibekov_names;
    return chain(spherical_joint_3D(turn, base, body),
                 inertia_3D(body, rigid_body{1.0, vec3{zero, zero, zero}, diagonal(1.0, 2.0, 3.0)}));
  }();

  template <class S>
  static joint_vector<S, 4> start_q() {
    return {S(1), S(0), S(0), S(0)};
  }
  template <class S>
  static joint_vector<S, 3> start_v() {
    return {S(S(1) / S(100)), S(10), S(S(1) / S(100))};
  }
  /// The rates in axes of the body, and the matrix from body to world axes by rows.
  template <class S>
  static Eigen::Matrix<S, 12, 1> output(const joint_vector<S, 4>& q, const joint_vector<S, 3>& v) {
    const auto R = forward_kinematics(model, q, dzhanibekov_names::body).rotation;
    Eigen::Matrix<S, 12, 1> r;
    r << v, to_eigen<S>(R.x), to_eigen<S>(R.y), to_eigen<S>(R.z);
    return r;
  }

  /// Integrated twice at 60 digits; Jacobi's functions agree to 38.
  static constexpr known<12> references[]{
      {1.0L,
       {-1.17326383719772847472810273226L, 9.93093912821562219110538423966L, 0.677433399352767348463004855490L,
        -0.839273862068208257159782628875L, 0.00655576159261163453184753143537L, -0.543669390750532303081915492485L,
        -0.0590542934461734387482922261415L, 0.992912636581958706650750513253L, 0.103136252314287790265363043587L,
        0.540492344880746093644653895378L, 0.118665572538137761681324631501L, -0.832938477331614562914238345032L}},
      {10.0L,
       {4.46960797706577079311162633191L, 8.94554104184593343190886085067L, 2.58054228594495048963556736310L,
        -0.0384736351680987685478304724968L, -0.388246837541830107633162424529L, 0.920751960375713679310003866357L,
        0.224960047839273853498101709979L, 0.894415221506541108831818460614L, 0.386541573978215986643342133647L,
        -0.973608112267509638830985431705L, 0.222004064548766275256137110270L, 0.0529286222258199748919792569767L}},
      {100.0L,
       {-0.619516718709476979323734032312L, 9.98079651306645179096227905638L, 0.357771325830973223322744504914L,
        0.561942523608398694728017142593L, -0.026512459333484548567793707618L, 0.826751286458457591958099438575L,
        -0.0300168599912958757655946371538L, 0.998174311169810198433540246608L, 0.0524121420754567546407842760087L,
        -0.826631470654781698637382022083L, -0.0542690889988513753522960773458L, 0.560120770640000041098900006066L}}};
};

}  // namespace kte::problems
