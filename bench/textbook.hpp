#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

#include "serial_robot.hpp"

/// The recursions of the textbook, in any scalar, as a second opinion: plain loops, no structure used. Vectors of six
/// are angular part first, in axes of the bodies. (Featherstone, Rigid Body Dynamics Algorithms, 2008, tables 5.1 and
/// 7.1)
namespace bench {

template <class R>
class textbook {
 public:
  using vector = Eigen::Matrix<R, Eigen::Dynamic, 1>;
  using vector3 = Eigen::Matrix<R, 3, 1>;
  using matrix3 = Eigen::Matrix<R, 3, 3>;

  explicit textbook(const serial_robot& robot) {
    for (const auto& l : robot.links) links_.push_back(link_of(l));
    gravity_ = robot.gravity.cast<R>();
    tool_rotation_ = orthonormal(robot.tool_rotation.cast<R>()), tool_position_ = robot.tool_position.cast<R>();
  }
  Eigen::Index dofs() const { return static_cast<Eigen::Index>(links_.size()); }

  /// The recursive Newton-Euler algorithm; without gravity for columns of the mass matrix.
  vector inverse_dynamics(const vector& q, const vector& v, const vector& a, bool gravity = true) const {
    std::vector<matrix6> x;
    std::vector<vector6> f;
    vector6 velocity = vector6::Zero(), acceleration = base_acceleration(gravity);
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const auto& l = links_[k];
      x.push_back(transform(l, q[i]));
      velocity = vector6(x[k] * velocity + l.s * v[i]);
      acceleration = vector6(x[k] * acceleration + l.s * a[i] + cross_motion(velocity) * (l.s * v[i]));
      f.push_back(l.inertia * acceleration - cross_motion(velocity).transpose() * (l.inertia * velocity));
    }
    vector tau(dofs());
    for (std::size_t k = links_.size(); k-- > 0;) {
      tau[static_cast<Eigen::Index>(k)] = (links_[k].s.transpose() * f[k])(0);
      if (k > 0) f[k - 1] += x[k].transpose() * f[k];
    }
    return tau;
  }

  /// The articulated-body algorithm.
  vector forward_dynamics(const vector& q, const vector& v, const vector& tau, bool gravity = true) const {
    const auto n = links_.size();
    std::vector<matrix6> x, inertia;
    std::vector<vector6> c, p, u(n);
    vector d(dofs()), rest(dofs());
    vector6 velocity = vector6::Zero();
    for (std::size_t k = 0; k < n; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const auto& l = links_[k];
      x.push_back(transform(l, q[i]));
      velocity = vector6(x[k] * velocity + l.s * v[i]);
      c.push_back(cross_motion(velocity) * (l.s * v[i]));
      inertia.push_back(l.inertia);
      p.push_back(-(cross_motion(velocity).transpose() * (l.inertia * velocity)));
    }
    for (std::size_t k = n; k-- > 0;) {
      const auto i = static_cast<Eigen::Index>(k);
      const auto& s = links_[k].s;
      u[k] = inertia[k] * s, d[i] = R(1) / (s.transpose() * u[k])(0);
      rest[i] = tau[i] - (s.transpose() * p[k])(0);
      if (k == 0) continue;
      const matrix6 ia = inertia[k] - u[k] * u[k].transpose() * d[i];
      const vector6 pa = p[k] + ia * c[k] + u[k] * (rest[i] * d[i]);
      inertia[k - 1] += x[k].transpose() * ia * x[k];
      p[k - 1] += x[k].transpose() * pa;
    }
    vector out(dofs());
    vector6 acceleration = base_acceleration(gravity);
    for (std::size_t k = 0; k < n; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const vector6 carried = x[k] * acceleration + c[k];
      out[i] = (rest[i] - (u[k].transpose() * carried)(0)) * d[i];
      acceleration = carried + links_[k].s * out[i];
    }
    return out;
  }

  /// Rotation and position of the tool in the base, and its Jacobian in axes of the base: linear part first.
  struct tool {
    matrix3 rotation;
    vector3 position;
    Eigen::Matrix<R, 6, Eigen::Dynamic> jacobian;
  };
  tool forward_kinematics(const vector& q) const {
    tool t{matrix3::Identity(), vector3::Zero(), Eigen::Matrix<R, 6, Eigen::Dynamic>(6, dofs())};
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      t.position += t.rotation * links_[k].position;
      t.rotation = matrix3(t.rotation * links_[k].rotation * turn(links_[k].axis, q[i]));
      t.jacobian.col(i) << t.position, t.rotation * links_[k].axis;  // where it stands, until the tool is known
    }
    t.position += t.rotation * tool_position_, t.rotation = matrix3(t.rotation * tool_rotation_);
    for (Eigen::Index i = 0; i < dofs(); ++i) {
      const vector3 w = t.jacobian.col(i).template tail<3>(), arm = t.position - t.jacobian.col(i).template head<3>();
      t.jacobian.col(i).template head<3>() = cross_matrix(w) * arm;
    }
    return t;
  }

  /// Sums over the bodies, in axes of the base.
  struct whole {
    R mass{0}, kinetic{0}, potential{0};  ///< J; potential relative to the origin of the base
    vector3 com = vector3::Zero();
    vector momentum = vector::Zero(6);  ///< linear part first; angular part about the centre of mass
  };
  whole sum_of_bodies(const vector& q, const vector& v) const {
    whole t;
    matrix3 rotation = matrix3::Identity();
    vector3 position = vector3::Zero(), velocity = vector3::Zero(), w = vector3::Zero(), about_base = vector3::Zero();
    for (std::size_t k = 0; k < links_.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const auto& l = links_[k];
      const vector3 arm = rotation * l.position;
      position += arm, velocity += cross_matrix(w) * arm;
      rotation = matrix3(rotation * l.rotation * turn(l.axis, q[i]));
      w += rotation * l.axis * v[i];
      const vector3 to_com = rotation * l.com, com = position + to_com, of_com = velocity + cross_matrix(w) * to_com;
      const vector3 spin = rotation * l.about_com * rotation.transpose() * w;
      t.mass += l.mass, t.com += l.mass * com;
      t.kinetic += (l.mass * (of_com.transpose() * of_com)(0) + (w.transpose() * spin)(0)) / R(2);
      t.potential -= l.mass * (gravity_.transpose() * com)(0);
      t.momentum.template head<3>() += l.mass * of_com;
      about_base += spin + cross_matrix(com) * (l.mass * of_com);
    }
    t.com /= t.mass;
    t.momentum.template tail<3>() = about_base - cross_matrix(t.com) * t.momentum.template head<3>();
    return t;
  }

 private:
  using vector6 = Eigen::Matrix<R, 6, 1>;
  using matrix6 = Eigen::Matrix<R, 6, 6>;
  struct link {
    matrix3 rotation;
    vector3 position, axis;
    matrix6 inertia;
    vector6 s;
    R mass;
    vector3 com;
    matrix3 about_com;  ///< the inertia
  };

  static matrix3 cross_matrix(const vector3& v) {
    matrix3 m;
    m << R(0), -v[2], v[1], v[2], R(0), -v[0], -v[1], v[0], R(0);
    return m;
  }
  /// The rotation nearest to a rounded one, by Newton's iteration.
  static matrix3 orthonormal(const matrix3& r) { return r * (matrix3::Identity() * R(3) - r.transpose() * r) / R(2); }
  static link link_of(const serial_link& l) {
    link k{orthonormal(l.rotation.cast<R>()),
           l.position.cast<R>(),
           l.axis.cast<R>(),
           {},
           {},
           R(l.mass),
           l.com.cast<R>(),
           l.inertia.cast<R>()};
    const matrix3 c = cross_matrix(l.com.cast<R>());
    const R m(l.mass);
    k.inertia << l.inertia.cast<R>() + m * (c * c.transpose()), m * c, m * c.transpose(), m * matrix3::Identity();
    k.s << k.axis, vector3::Zero();
    return k;
  }
  /// About a unit axis (Rodrigues).
  static matrix3 turn(const vector3& n, const R& q) {
    using std::cos, std::sin;
    const R c = cos(q), s = sin(q);
    return c * matrix3::Identity() + s * cross_matrix(n) + (R(1) - c) * n * n.transpose();
  }
  /// Of motions of the body before to motions of this one.
  static matrix6 transform(const link& l, const R& q) {
    const matrix3 e = (l.rotation * turn(l.axis, q)).transpose();
    matrix6 x;
    x << e, matrix3::Zero(), -(e * cross_matrix(l.position)), e;
    return x;
  }
  static matrix6 cross_motion(const vector6& v) {
    matrix6 x;
    x << cross_matrix(v.template head<3>()), matrix3::Zero(), cross_matrix(v.template tail<3>()),
        cross_matrix(v.template head<3>());
    return x;
  }
  vector6 base_acceleration(bool gravity) const {
    vector6 a = vector6::Zero();
    if (gravity) a.template tail<3>() = -gravity_;
    return a;
  }

  std::vector<link> links_;
  vector3 gravity_, tool_position_;
  matrix3 tool_rotation_;
};

}  // namespace bench
