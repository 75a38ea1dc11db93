#pragma once

#include <kte/contact/friction_problem.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

/// Random friction problems of rigid bodies: W = J M^-1 J^T, b = J v.
namespace kte::test {

/// The numbers of a problem.
struct friction_scene {
  Eigen::MatrixXd W;
  Eigen::VectorXd b;
  std::vector<friction_contact<double>> contacts;

  friction_problem<double> problem() const { return {W, b, contacts}; }
};

/// How far lambda is from the laws of friction, relative to the largest lambda or b/W_ii, and b: their products, so
/// that no step length is needed as in the residual of the solver.
inline double violation(const friction_scene& s, std::span<const double> found) {
  const Eigen::Map<const Eigen::VectorXd> lambda(found.data(), s.b.size());
  const Eigen::VectorXd u = s.W * lambda + s.b;
  const double speed = s.b.cwiseAbs().maxCoeff(),
               force = std::max(lambda.cwiseAbs().maxCoeff(), speed / s.W.diagonal().maxCoeff());
  double worst = 0;
  Eigen::Index r = 0;
  for (const auto& contact : s.contacts) {
    const Eigen::Index t = contact.rows - 1;
    const Eigen::VectorXd lt = lambda.segment(r + 1, t), ut = u.segment(r + 1, t);
    const double mu = contact.friction;
    worst = std::max({worst, -lambda[r] / force, -u[r] / speed, std::abs(lambda[r] * u[r]) / (force * speed),
                      (lt.norm() - mu * lambda[r]) / force,
                      (lt * ut.norm() + mu * lambda[r] * ut).norm() / (force * speed)});
    r += contact.rows;
  }
  return worst;
}

/// Draws problems.
class friction_scenes {
 public:
  explicit friction_scenes(unsigned seed) : random_(seed) {}

  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double normal() { return std::normal_distribution<double>()(random_); }
  Eigen::Vector3d direction() { return Eigen::Vector3d(normal(), normal(), normal()).normalized(); }

  /// Points of one body on a plane: a plate.
  friction_scene plate(int points, double mu = 0.5) {
    Eigen::MatrixXd J(3 * points, 6);
    for (int i = 0; i < points; ++i)
      J.middleRows<3>(3 * i) = rows({uniform(-1, 1), uniform(-1, 1), -0.2}, Eigen::Matrix3d::Identity());
    return made(J, body(uniform(0.5, 2)), state(6, {0, 0, -1, 0, 0, 0}), mu);
  }
  /// Points on all sides of one body, with random normals.
  friction_scene points(int n, double mu = 0.5) {
    Eigen::MatrixXd J(3 * n, 6);
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d z = direction();
      const Eigen::Vector3d x = z.unitOrthogonal();
      Eigen::Matrix3d axes;
      axes << x, z.cross(x), z;
      J.middleRows<3>(3 * i) = rows(direction() * uniform(0.2, 1), axes);
    }
    return made(J, body(uniform(0.5, 2)), state(6, {0, 0, 0, 0, 0, 0}), mu);
  }
  /// Legs: a body with a point mass of a tenth under each of its points, which alone touch.
  friction_scene legs(int n, double mu = 0.5) {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3 * n, 6 + 3 * n);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(6 + 3 * n, 6 + 3 * n);
    inverse.topLeftCorner<6, 6>() = body(1);
    Eigen::VectorXd v = state(6 + 3 * n, {0, 0, -1, 0, 0, 0});
    for (int i = 0; i < n; ++i) {
      J.block<3, 6>(3 * i, 0) = rows({uniform(-1, 1), uniform(-1, 1), -0.3}, Eigen::Matrix3d::Identity());
      Eigen::Matrix3d root;
      for (int k = 0; k < 9; ++k) root(k) = uniform(-1, 1);
      J.block<3, 3>(3 * i, 6 + 3 * i) = swap() * root;
      inverse.block<3, 3>(6 + 3 * i, 6 + 3 * i).setIdentity();
    }
    return made(J, inverse, v, mu);
  }
  /// Points of one body in the plane, with normals within +-spread of a direction.
  friction_scene plane(int points, double mu, double spread) {
    Eigen::MatrixXd J(2 * points, 3);
    for (int i = 0; i < points; ++i) {
      const double angle = spread * uniform(-1, 1), x = uniform(-1, 1), y = uniform(-1, 1), c = std::cos(angle),
                   s = std::sin(angle);
      J.row(2 * i) << -s, c, c * x + s * y;
      J.row(2 * i + 1) << c, s, s * x - c * y;
    }
    const Eigen::Vector3d inverse(1, 1, uniform(1, 6));
    friction_scene s = made(J, inverse.asDiagonal(), state(3, {0, -1, 0}), mu);
    s.contacts.assign(static_cast<std::size_t>(points), {.rows = 2, .friction = mu});
    return s;
  }
  /// Boxes of masses 1, 10, 1, ... on each other, four points each.
  friction_scene tower(int boxes, double mu = 0.5, double kick = 1) {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(12 * boxes, 6 * boxes);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(6 * boxes, 6 * boxes);
    Eigen::VectorXd v(6 * boxes);
    for (int k = 0; k < boxes; ++k) {
      const double m = k % 2 == 0 ? 1 : 10;
      inverse.block<6, 6>(6 * k, 6 * k) =
          Eigen::Matrix<double, 6, 1>(1 / m, 1 / m, 1 / m, 6 / m, 6 / m, 6 / m).asDiagonal();
      for (int c = 0; c < 4; ++c) {
        const double x = c & 1 ? 0.5 : -0.5, y = c & 2 ? 0.5 : -0.5;
        J.block<3, 6>(12 * k + 3 * c, 6 * k) = rows({x, y, -0.5}, Eigen::Matrix3d::Identity());
        if (k > 0) J.block<3, 6>(12 * k + 3 * c, 6 * (k - 1)) = -rows({x, y, 0.5}, Eigen::Matrix3d::Identity());
      }
      for (int i = 0; i < 6; ++i) v(6 * k + i) = kick * normal();
      v(6 * k + 2) -= 1;
    }
    return made(J, inverse, v, mu);
  }

 private:
  static Eigen::Matrix3d swap() {
    Eigen::Matrix3d n;
    n << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    return n;
  }
  /// Rows (n, t1, t2) of the velocity of a point of a body; z of the axes is the normal.
  static Eigen::Matrix<double, 3, 6> rows(const Eigen::Vector3d& p, const Eigen::Matrix3d& axes) {
    Eigen::Matrix3d cross;
    cross << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0;
    Eigen::Matrix<double, 3, 6> J;
    J << Eigen::Matrix3d::Identity(), -cross;
    return swap() * axes.transpose() * J;
  }
  Eigen::Matrix<double, 6, 6> body(double m) {
    const Eigen::Matrix3d turned =
        Eigen::Quaterniond(normal(), normal(), normal(), normal()).normalized().toRotationMatrix();
    const double x = uniform(0.1, 1), y = uniform(0.1, 1), z = uniform(0.1, 1);
    Eigen::Matrix<double, 6, 6> inverse = Eigen::Matrix<double, 6, 6>::Zero();
    inverse.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / m;
    inverse.bottomRightCorner<3, 3>() =
        turned * Eigen::Vector3d(3 / (y * y + z * z), 3 / (x * x + z * z), 3 / (x * x + y * y)).asDiagonal() *
        turned.transpose() / m;
    return inverse;
  }
  Eigen::VectorXd state(int n, const std::vector<double>& mean) {
    Eigen::VectorXd v(n);
    for (int i = 0; i < n; ++i)
      v(i) = normal() + (i < static_cast<int>(mean.size()) ? mean[static_cast<std::size_t>(i)] : 0);
    return v;
  }
  static friction_scene made(const Eigen::MatrixXd& J, const Eigen::MatrixXd& inverse, const Eigen::VectorXd& v,
                             double mu) {
    friction_scene s;
    s.W = J * inverse * J.transpose();
    s.W = (s.W + s.W.transpose()).eval() / 2;
    s.b = J * v;
    s.contacts.assign(static_cast<std::size_t>(J.rows() / 3), {.rows = 3, .friction = mu});
    return s;
  }

  std::mt19937_64 random_;
};

}  // namespace kte::test
