#pragma once

#include <kte/view/scene.hpp>

#include <cmath>

/// Scenes made by hand, for tests of pictures.
namespace kte::test {

/// Adds a pose of each track at a time: x, y, z and a turn about z.
inline void add_row(scene& s, double t, const std::vector<std::array<double, 4>>& poses) {
  auto& r = s.recordings.front();
  r.t.push_back(t);
  for (const auto& p : poses) {
    for (std::size_t i = 0; i < 3; ++i) r.positions.push_back(static_cast<float>(p[i]));
    for (const double w : {std::cos(p[3] / 2), 0.0, 0.0, std::sin(p[3] / 2)})
      r.rotations.push_back(static_cast<std::int16_t>(std::lround(32767 * w)));
  }
}

/// A double pendulum of two rods of 1 m and 0.8 m in the plane, with a spring from its elbow to the ground and a damper
/// beside it, that turns evenly for 2 s.
inline scene double_pendulum() {
  scene s;
  s.title = "double pendulum", s.dimension = 2, s.gravity = {0, -9.81, 0}, s.size = 1.8, s.tracks = 2;
  s.frames = {{"base", -1, -1},
              {"upper", 0},
              {"elbow", -1, 1, {1, 0, 0, 1, 0, 0, 0}},
              {"lower", 1},
              {"tip", -1, 3, {0.8, 0, 0, 1, 0, 0, 0}},
              {"wall", -1, -1, {1.6, -0.2, 0, 1, 0, 0, 0}}};
  s.coordinates = {{"q1", "angle", "rad", 0, 1, 0, 1}, {"q2", "angle", "rad", 1, 1, 1, 1}};
  s.joints = {{"q1", "revolute_joint_2D", "revolute", 0, 1, true, {0, 0, 1}, {0}},
              {"q2", "revolute_joint_2D", "revolute", 2, 3, true, {0, 0, 1}, {1}}};
  s.links = {{"rigid_link_2D", 1, 2}, {"rigid_link_2D", 3, 4}};
  s.bodies = {{"", 2, 1.5}, {"rod", 4, 1, {-0.4, 0, 0}, {1, 0, 0, 0}, {0.4, 0.05, 0.05}}};
  s.forces = {{"", "spring_2D", "spring", {2, 5}, {}},
              {"", "damper_2D", "damper", {4, 5}, {}},
              {"motor", "driving_actuator_gen", "motor", {}, {0}}};
  s.recordings.emplace_back();
  for (int i = 0; i <= 40; ++i) {
    const double t = i / 20.0, a = -1.5 + 0.7 * t, b = a + 0.9 * t;
    add_row(s, t, {{0, 0, 0, a}, {std::cos(a), std::sin(a), 0, b}});
  }
  return s;
}

/// One joint of each kind in space, along x in turn, with a link between each two, at rest.
inline scene all_joints() {
  scene s;
  s.title = "all joints", s.gravity = {0, 0, -9.81}, s.size = 3;
  s.frames = {{"ground", -1, -1}};
  s.recordings.emplace_back();
  std::vector<std::array<double, 4>> row;
  double x = 0;
  for (const char* kind : {"revolute", "prismatic", "screw", "cylindrical", "universal", "spherical", "planar", "fixed",
                           "other", "free"}) {
    const int before = static_cast<int>(s.frames.size()) - 1, track = s.tracks++;
    row.push_back({x, 0, 0, 0.1});
    s.frames.push_back({kind, track});
    s.joints.push_back({std::string("q_") + kind,
                        std::string(kind) + "_joint_3D",
                        kind,
                        before,
                        before + 1,
                        true,
                        {0.3, 0.8, 0.52},
                        {}});
    s.frames.push_back({std::string(kind) + "_end", -1, before + 1, {0.4, 0, 0.1, 1, 0, 0, 0}});
    s.links.push_back({"rigid_link_3D", before + 1, before + 2});
    s.bodies.push_back({kind, before + 2, 1, {-0.1, 0, 0}, {1, 0, 0, 0}, {0.15, 0.1, 0.06}});
    x += 0.4;
  }
  add_row(s, 0, row);
  return s;
}

}  // namespace kte::test
