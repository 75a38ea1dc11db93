#pragma once

#include <kte/runtime_chain.hpp>

#include <Eigen/Geometry>

#include <array>
#include <functional>
#include <string>
#include <vector>

/// Scenes of contact whose solutions are known, and what methods make of them.
namespace contact_bench {

/// A motion from q and v at rest or not, to the time `end`, s.
struct scene {
  std::string name;
  kte::runtime_chain chain;
  Eigen::VectorXd q, v;
  double end = 0;
  std::function<double(const Eigen::VectorXd& q)> error;  ///< at the end
};

/// What a method has made of a scene.
struct row {
  std::string scene, method, setting;
  double error = 0;
  long long work = 0;  ///< evaluations or steps
  double seconds = 0;
};

constexpr double g = 9.81;

/// A ball of radius 0.1 m whose lowest point is 1 m high, e = 1/2, after 1 s: the third flight. Error in m.
scene bouncing_ball();
/// A box on corners (+-0.1, -0.05) m at 2 m/s up a slope of 0.3, mu 0.2: it comes back. Error of its place after 2 s,
/// m.
scene sliding_box();
/// That box with mu 0.4: it rests from 0.3 s on. Error after 10 s, m.
scene resting_box();
/// A ball of radius 0.1 m at 1 m/s on the ground, mu 0.2: slides, then rolls. Error of its place after 2 s, m.
scene slipping_ball();
/// A wheel of eight spokes of 1 m without a rim, down a slope of 0.15, in its steady motion, for ten strikes. Error of
/// its mean speed, rad/s.
scene rimless_wheel();
/// The Solo12, PD control 10 Nm/rad and 0.3 Nms/rad, from a height of 0.28 m, roll 0.05, pitch 0.03, mu 0.7, after 0.2
/// s. Error of the trunk, m, from the place to which events (tolerances 1e-10 to 1e-12) converge, and moreau_jean (h
/// from 1e-6 to 3e-8, order 1).
scene falling_quadruped();
inline const Eigen::Vector3d place_of_quadruped{-0.0273951303052, 0.0130719553692, 0.2287623383905};

/// The joints of the quadruped, in the order of q, and what its servos want, rad.
struct servo {
  std::string joint;
  double target;
};
std::array<servo, 12> servos();

std::vector<scene> scenes();

/// The rows of a method; mujoco_rows are empty where MuJoCo is not installed.
std::vector<row> event_rows(const scene& s, bool quick);
std::vector<row> moreau_jean_rows(const scene& s, bool quick);
std::vector<row> mujoco_rows(const scene& s, bool quick);

}  // namespace contact_bench
