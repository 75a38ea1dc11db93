#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace kte {

/// Options of a picture of a mechanism: `kte::write_picture("swing.svg", scene, {.every = 0.1, .trails = {"tip"}})`.
struct picture_options {
  double width = 85;            ///< mm; the height follows from the mechanism
  double most_height = 0;       ///< mm; 0 for 1.2 times the width
  std::string title{};          ///< for screen readers; empty for that of the scene
  std::vector<double> times{};  ///< s: the mechanism at these times over each other, the last one darkest
  double every = 0;  ///< s: draws all multiples of this from the first time; 0 without `times`: the first time only
  double from = -std::numeric_limits<double>::infinity();  ///< s: of `every`, trails and moving pictures
  double to = std::numeric_limits<double>::infinity();
  std::vector<std::string> trails{};            ///< frames whose paths are drawn
  std::vector<std::string> labels{};            ///< frames whose names are written beside them
  std::array<double, 3> look_from{1, -2, 0.8};  ///< direction of view; planar scenes are seen from +z
  double palest = 0.2;                          ///< opacity of the first of several times
  double joint_radius = 1.3;                    ///< mm
  double font_size = 8;                         ///< points of 1/72 inch
  std::string font = "sans-serif";
  bool bodies = true, joints = true, ground = true, scale_bar = true;  ///< whether they are drawn
  std::size_t recording = 0;                                           ///< of the scene
  double rate = 25;  ///< of moving pictures: positions a second; between them parts move on straight lines
  double speed = 1;  ///< of moving pictures: 0.5 is half as fast as the mechanism
};

}  // namespace kte
