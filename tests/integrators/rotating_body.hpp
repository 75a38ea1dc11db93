#pragma once

#include <Eigen/Geometry>

#include <cmath>

namespace kte::test {

/// A rigid body that turns under a torque that changes with time, with drag:
///
///   q' = q (0, w) / 2,   I w' = tau(t) - w x I w - drag w,   I = diag(1, 2, 5/2)                 (1)
///
/// State: the unit quaternion q = w, x, y, z from body to world axes, then body rates w. Displacements: a rotation
/// vector in body axes, then the change of w. With the rotation vector p, of length a (dexp^-1):
///
///   p' = w + p x w / 2 + (1 - a/2 cot a/2) / a^2 p x (p x w)                                     (2)
template <class S>
struct rotating_body {
  using state = Eigen::Matrix<S, 7, 1>;
  using rate = Eigen::Matrix<S, 6, 1>;
  using vector = Eigen::Matrix<S, 3, 1>;

  S drag{};

  static state start() {
    state x;
    x << S(0.5), S(0.5), S(-0.5), S(0.5), S(1), S(-0.5), S(0.25);
    return x;
  }
  Eigen::Index rates() const { return 6; }
  rate operator()(const S& t, const state& x) const {
    using std::cos, std::sin;
    const vector inertia(S(1), S(2), S(2.5)), w = x.template tail<3>(), torque(sin(t), cos(2 * t), S(0.5));
    rate r;
    r << w, (torque - w.cross(inertia.cwiseProduct(w)) - drag * w).cwiseQuotient(inertia);  // (1)
    return r;
  }
  void displace(const state& x, const rate& d, state& out) const {
    using std::cos, std::sin;
    const vector p = d.template head<3>(), v = x.template segment<3>(1);
    const S a = p.norm(), c = cos(a / 2), by = a < S(1e-5) ? S(0.5) - a * a / 48 : sin(a / 2) / a;
    out[0] = x[0] * c - by * v.dot(p);
    out.template segment<3>(1) = c * v + by * (x[0] * p + v.cross(p));
    out.template tail<3>() = x.template tail<3>() + d.template tail<3>();
  }
  void pull_back(const rate& d, rate& r) const {
    using std::tan;
    const vector p = d.template head<3>(), w = r.template head<3>(), pw = p.cross(w);
    const S a = p.norm(), by = a < S(1e-3) ? S(1) / 12 + a * a / 720 : (1 - a / (2 * tan(a / 2))) / (a * a);
    r.template head<3>() += pw / 2 + by * p.cross(pw);  // (2)
  }
  void magnitudes(const state& x, rate& m) const { m << vector::Ones(), x.template tail<3>(); }
};

}  // namespace kte::test
