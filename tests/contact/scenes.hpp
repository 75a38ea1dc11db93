#pragma once

#include <kte/contact/friction_problem.hpp>

#include <Eigen/Dense>

#include <random>
#include <vector>

/// Random friction problems of rigid bodies: W = J M^-1 J^T, b = J v.
namespace kte::test {

struct scene {
  Eigen::MatrixXd W;
  Eigen::VectorXd b;
  std::vector<friction_contact<double>> contacts;

  friction_problem<double> problem() const { return {W, b, contacts}; }
};

class scenes {
 public:
  explicit scenes(unsigned seed) : random_(seed) {}

  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double normal() { return std::normal_distribution<double>()(random_); }
  Eigen::Vector3d direction() { return Eigen::Vector3d(normal(), normal(), normal()).normalized(); }

  /// Points of one body on a plane: a plate.
  scene plate(int points, double mu = 0.5) {
    Eigen::MatrixXd J(3 * points, 6);
    for (int i = 0; i < points; ++i)
      J.middleRows<3>(3 * i) = rows({uniform(-1, 1), uniform(-1, 1), -0.2}, Eigen::Matrix3d::Identity());
    return made(J, body(uniform(0.5, 2)), state(6, {0, 0, -1, 0, 0, 0}), mu);
  }
  /// Points on all sides of one body, with random normals.
  scene points(int n, double mu = 0.5) {
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
  scene legs(int n, double mu = 0.5) {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3 * n, 6 + 3 * n);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(6 + 3 * n, 6 + 3 * n);
    inverse.topLeftCorner<6, 6>() = body(1);
    Eigen::VectorXd v = state(6 + 3 * n, {0, 0, -1, 0, 0, 0});
    for (int i = 0; i < n; ++i) {
      J.block<3, 6>(3 * i, 0) = rows({uniform(-1, 1), uniform(-1, 1), -0.3}, Eigen::Matrix3d::Identity());
      const Eigen::Matrix3d root = Eigen::Matrix3d::Random();
      J.block<3, 3>(3 * i, 6 + 3 * i) = swap() * root;
      inverse.block<3, 3>(6 + 3 * i, 6 + 3 * i).setIdentity();
    }
    return made(J, inverse, v, mu);
  }
  /// Boxes of masses 1, 10, 1, ... on each other, four points each.
  scene tower(int boxes, double mu = 0.5, double kick = 1) {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(12 * boxes, 6 * boxes);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(6 * boxes, 6 * boxes);
    Eigen::VectorXd v(6 * boxes);
    for (int k = 0; k < boxes; ++k) {
      const double m = k % 2 == 0 ? 1 : 10;
      inverse.block<6, 6>(6 * k, 6 * k) = Eigen::Matrix<double, 6, 1>(1 / m, 1 / m, 1 / m, 6 / m, 6 / m, 6 / m).asDiagonal();
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
    Eigen::Matrix3d turned = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
    const double x = uniform(0.1, 1), y = uniform(0.1, 1), z = uniform(0.1, 1);
    Eigen::Matrix<double, 6, 6> inverse = Eigen::Matrix<double, 6, 6>::Zero();
    inverse.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / m;
    inverse.bottomRightCorner<3, 3>() =
        turned * Eigen::Vector3d(3 / (y * y + z * z), 3 / (x * x + z * z), 3 / (x * x + y * y)).asDiagonal() * turned.transpose() / m;
    return inverse;
  }
  Eigen::VectorXd state(int n, const std::vector<double>& mean) {
    Eigen::VectorXd v(n);
    for (int i = 0; i < n; ++i) v(i) = normal() + (i < 6 ? mean[static_cast<std::size_t>(i)] : 0);
    return v;
  }
  static scene made(const Eigen::MatrixXd& J, const Eigen::MatrixXd& inverse, const Eigen::VectorXd& v, double mu) {
    scene s;
    s.W = J * inverse * J.transpose();
    s.W = (s.W + s.W.transpose()).eval() / 2;
    s.b = J * v;
    s.contacts.assign(static_cast<std::size_t>(J.rows() / 3), {.rows = 3, .friction = mu});
    return s;
  }

  std::mt19937_64 random_;
};

}  // namespace kte::test
