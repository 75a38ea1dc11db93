#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace kte {

/// What a picture of a mechanism needs, as data: SI units, poses of frames in the world, indices from 0.
/// `scene_of` makes it of a chain, `to_json` writes it in the format "kte-scene-1" (docs/view.md).
struct scene {
  static constexpr double none = std::numeric_limits<double>::infinity();
  /// Position x y z, m, and unit quaternion w x y z.
  using pose = std::array<double, 7>;
  static constexpr pose at_origin{0, 0, 0, 1, 0, 0, 0};

  /// A frame moves by a track of the recordings, or is rigid in a frame before it: `parent`; -1 is the world.
  struct frame {
    std::string name;
    int track = -1;
    int parent = -1;
    pose place = at_origin;  ///< in the parent
  };
  /// A coordinate. One that follows others has no place in q and v: -1.
  struct coordinate {
    std::string name;
    std::string kind;  ///< angle, length, rotation, pose, pose_2D; number where no joint says what it is
    std::string unit;  ///< rad, m, 1
    int q = -1, size = 1;
    int v = -1, v_size = 1;
    double lower = -none, upper = none;
    bool follows = false;
  };
  struct joint {
    std::string name, type;
    std::string
        kind;  ///< revolute, prismatic, screw, spherical, planar, free; other of elements that kte does not know
    int before = -1, after = -1;  ///< frames
    bool has_axis = false;
    std::array<double, 3> axis{};  ///< in axes of `before`
    std::vector<int> coordinates;
    double lower = -none, upper = none;
  };
  /// A line between two frames.
  struct link {
    std::string type;
    int from = -1, to = -1;
  };
  struct body {
    std::string name;
    int frame = -1;
    double mass = 0;                                ///< kg
    std::array<double, 3> centre{};                 ///< in the frame
    std::array<double, 4> orientation{1, 0, 0, 0};  ///< of the ellipsoid in the frame
    std::array<double, 3> ellipsoid{};  ///< half axes of the homogeneous ellipsoid of equal inertia; 0 of a point
  };
  /// What acts: springs, dampers, motors, limits, and all else that is in the chain.
  struct force {
    std::string name, type;
    std::string kind;  ///< spring, torsion_spring, damper, beam, bushing, motor, limit, friction, loop, other
    std::vector<int> frames, coordinates;
    int element = -1;  ///< its number in `model`
  };
  /// Sizes, m: box: lengths; sphere: radius; cylinder, capsule: radius, length along z without caps; ellipsoid: half
  /// axes; plane: lengths, 0 0 without end; mesh: none.
  struct shape {
    int frame = -1;
    pose place = at_origin;
    std::string type;
    std::vector<double> size;
    std::vector<double> colour;  ///< red, green, blue, opacity from 0 to 1; or none
    bool collision = false;
    int mesh = -1;
  };
  struct mesh {
    std::string name;
    std::vector<float> positions;        ///< x y z of each vertex
    std::vector<std::uint32_t> indices;  ///< three of each triangle
  };
  struct column {
    std::string name, unit;
    std::vector<float> data;  ///< NaN is a gap
  };
  /// Poses of tracks and the coordinates q at times that do not decrease.
  struct recording {
    std::string name;
    std::vector<double> t;
    std::vector<float> positions;         ///< of each time and track, x y z
    std::vector<std::int16_t> rotations;  ///< likewise, w x y z times 32767
    std::vector<float> q;
    /// By which a page knows forces: the velocities v; inputs, vectors and internal states, in the order of their first
    /// appearance. None where they are not known; NaN is one that is not.
    std::vector<float> v, signals;
    std::vector<column> columns;
  };

  std::string title;
  int dimension = 3;  ///< 2: in the plane x y
  std::array<double, 3> gravity{};
  double size = 1;  ///< a typical length, for symbols
  std::vector<frame> frames;
  int tracks = 0;
  std::vector<coordinate> coordinates;
  std::vector<joint> joints;
  std::vector<link> links;
  std::vector<body> bodies;
  std::vector<force> forces;
  std::vector<int> pulls;  ///< frames that a live page may pull
  std::vector<shape> shapes;
  std::vector<mesh> meshes;
  std::vector<std::string> notes;  ///< what is not drawn, or not as it is
  std::vector<recording> recordings;
  std::string model;  ///< the chain as a model file in JSON, for a page that simulates; empty if files cannot hold it
  std::vector<double> q, v;  ///< the state at the start
};

/// As JSON, "kte-scene-1". Bytes in names that are no UTF-8 become U+FFFD. Throws `bad_argument` for a scene whose
/// parts do not fit together.
std::string to_json(const scene& s);

}  // namespace kte
