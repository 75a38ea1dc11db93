#pragma once

#include <Eigen/Geometry>

#include "data/problems/error.hpp"

namespace kte::problems {

/// A free body with principal moments I = (2, 1, 2/3) kg m^2 and the body momentum (cos 1.1, 0, sin 1.1) at the start:
///
///   q' = q (0, w) / 2,   I w' = I w x w                    (1)
///
/// State: the unit quaternion w, x, y, z that turns from body to world axes, then the body rates w, rad/s. The moments
/// break the triangle inequality, so no real body has them and no chain takes them; (1) does not mind.
/// Hairer, Lubich and Wanner, Geometric Numerical Integration, 2006, VII.5.
template <class S = double>
struct euler_top {
  static constexpr const char* name = "Euler top";
  static constexpr int size = 7;
  static constexpr long double t_end = 100L;
  using state = Eigen::Matrix<S, size, 1>;

  static state start() {
    using std::cos, std::sin;
    const S angle = S(11) / S(10);
    state x = state::Zero();
    x[0] = 1, x[4] = cos(angle) / 2, x[6] = 3 * sin(angle) / 2;
    return x;
  }
  state operator()(const S&, const state& x) const {
    const S &u = x[4], &v = x[5], &w = x[6];
    state f;
    f[0] = -(x[1] * u + x[2] * v + x[3] * w) / 2;
    f[1] = (x[0] * u + x[2] * w - x[3] * v) / 2;
    f[2] = (x[0] * v + x[3] * u - x[1] * w) / 2;
    f[3] = (x[0] * w + x[1] * v - x[2] * u) / 2;
    f[4] = v * w / 6, f[5] = -4 * w * u / 3, f[6] = 3 * u * v / 2;  // (1)
    return f;
  }
  /// J; constant.
  S energy(const state& x) const { return x[4] * x[4] + x[5] * x[5] / 2 + x[6] * x[6] / 3; }
  /// What the references are of: body rates, and the matrix from body to world axes by rows.
  static Eigen::Matrix<S, 12, 1> output(const state& x) {
    Eigen::Matrix<S, 12, 1> r;
    r << x.template tail<3>(), rotation(x).row(0).transpose(), rotation(x).row(1).transpose(),
        rotation(x).row(2).transpose();
    return r;
  }
  /// The angular momentum in world axes; constant.
  static Eigen::Matrix<S, 3, 1> momentum(const state& x) {
    return rotation(x) * Eigen::Matrix<S, 3, 1>(2 * x[4], x[5], 2 * x[6] / 3);
  }

  /// Integrated twice at 60 digits, by extrapolation of different orders; only digits on which both agree.
  static constexpr known<12> references[3]{
      {1.0L,
       {0.184555040425230332960233924673L, -0.372846321121433451499064100470L, 1.27697790910483391406582487730L,
        0.250395021913908805973690638288L, -0.968143726725089498026354923650L, 2.39590459650850604825218137883e-4L,
        0.924711211353376211274277051570L, 0.239088584001333887751787825105L, -0.296219217130841630471204340578L,
        0.286725493456903338503185920544L, 0.0743933693489704511128772225458L, 0.955119949534508961100623986654L}},
      {10.0L,
       {0.203533068294020405429656236165L, 0.283007426812844076000198726364L, 1.30267375149234246557163644695L,
        0.451020032238587055101362693268L, -0.709109182958361459891818078740L, 0.541982561678536800137538703254L,
        0.863110432376152967541600336600L, 0.191947723708125277454872238491L, -0.467115031749910052623060675559L,
        0.227203239508054041131949342779L, 0.678469039829669939375753828492L, 0.698611802040053984570802031301L}},
      {100.0L,
       {-0.0886741569374869795781887253803L, -0.590418524333427168633573457990L, 1.18105692868789964871514799067L,
        0.710824109474679911376481827377L, -0.660947378779249852567301982004L, 0.240577737694839690909104172153L,
        0.424558247102987734437260943471L, 0.675879235494079907252231670594L, 0.602442988045156420899242674101L,
        -0.560784611242468631674111755059L, -0.326091737878740032546366627984L, 0.761041916244339610956607638543L}}};
  static constexpr const auto& reference = references[2].values;

 private:
  static Eigen::Matrix<S, 3, 3> rotation(const state& x) {
    return Eigen::Quaternion<S>(x[0], x[1], x[2], x[3]).normalized().toRotationMatrix();
  }
};

}  // namespace kte::problems
