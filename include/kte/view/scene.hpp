#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace kte {

/// A mechanism to be drawn, as data: SI units, poses of frames in the world, indices from 0, -1 for none, `none`
/// (infinite) for no limit. `scene_of` makes it of a chain, `to_json` writes it in the format "kte-scene-1"
/// (docs/view.md). It has a `title`, `gravity`, m/s^2, and lists of parts; `tracks`: the number of moving frames in
/// recordings.
struct scene {
  static constexpr double none = std::numeric_limits<double>::infinity();
  /// Position x y z, m, and unit quaternion w x y z.
  using pose = std::array<double, 7>;
  /// The identity pose.
  static constexpr pose at_origin{0, 0, 0, 1, 0, 0, 0};

  /// A frame `name`. It moves by a `track` of the recordings, or is rigid in a frame before it, its `parent`; -1 is the
  /// world.
  struct frame {
    std::string name;
    int track = -1;
    int parent = -1;
    pose place = at_origin;  ///< pose in the parent
  };
  /// A coordinate `name`: its first index q and `size` in q, v and `v_size` in v, -1 if it `follows` others; its range
  /// from `lower` to `upper`.
  struct coordinate {
    std::string name;
    std::string kind;  ///< angle, length, rotation, pose, pose_2D; number if no joint has it
    std::string unit;  ///< rad, m, 1
    int q = -1, size = 1;
    int v = -1, v_size = 1;
    double lower = -none, upper = none;
    bool follows = false;
  };
  /// A joint: its `name`, `type` of element, `coordinates`, and range from `lower` to `upper`; `has_axis` tells whether
  /// it has an axis.
  struct joint {
    std::string name, type;
    std::string
        kind;  ///< revolute, prismatic, screw, spherical, planar, free; other for elements outside of this library
    int before = -1, after = -1;  ///< frames
    bool has_axis = false;
    std::array<double, 3> axis{};  ///< in axes of `before`
    std::vector<int> coordinates;
    double lower = -none, upper = none;
  };
  /// A line between two frames, `from` and `to`.
  struct link {
    std::string type;
    int from = -1, to = -1;
  };
  /// A rigid body: its `name` and its `frame`.
  struct body {
    std::string name;
    int frame = -1;
    double mass = 0;  ///< kg
    std::array<double, 3> centre{};
    std::array<double, 4> orientation{1, 0, 0, 0};  ///< of the ellipsoid in the frame
    std::array<double, 3> ellipsoid{};  ///< half axes of the homogeneous ellipsoid of equal inertia; 0 of a point
  };
  /// An element that acts by forces: springs, dampers, motors, limits and others, with its `name`, its `type`, and the
  /// `frames` and `coordinates` it acts on.
  struct force {
    std::string name, type;
    std::string kind;  ///< spring, torsion_spring, damper, beam, bushing, motor, limit, friction, loop, contact, other
    std::vector<int> frames, coordinates;
    int element = -1;  ///< its number in `model`
  };
  /// A shape at `place` in a `frame`, visual, `collision`, or of a `contact` of the chain, with a `mesh` if it is one.
  /// `size`, m: box: lengths; sphere: radius; cylinder, capsule: radius, length along z without caps, of a cylinder 0
  /// for an infinite one; ellipsoid: half axes; plane: lengths, 0 0 for an infinite one; mesh: none. `type` is one of
  /// these names.
  struct shape {
    int frame = -1;
    pose place = at_origin;
    std::string type;
    std::vector<double> size;
    std::vector<double> colour;  ///< red, green, blue, opacity from 0 to 1; or none
    bool collision = false;
    int mesh = -1;
    bool contact = false;
  };
  /// A mesh of triangles, with its `name`.
  struct mesh {
    std::string name;
    std::vector<float> positions;        ///< x y z of each vertex
    std::vector<std::uint32_t> indices;  ///< three of each triangle
  };
  /// A quantity to be plotted: its `name`, `unit` and `data` at the times of the recording.
  struct column {
    std::string name, unit;
    std::vector<float> data;  ///< NaN is a gap
  };
  /// A recording: its `name`, poses of tracks and coordinates q at times `t`, s, that do not decrease, and `columns`.
  struct recording {
    std::string name;
    std::vector<double> t;
    std::vector<float> positions;         ///< x y z for each time and track
    std::vector<std::int16_t> rotations;  ///< w x y z times 32767 for each time and track
    std::vector<float> q;
    /// Data by which a page computes forces: the velocities v; inputs, vectors and internal states, in the order of
    /// their first appearance. Empty if they are unknown; NaN is an unknown value.
    std::vector<float> v, signals;
    std::vector<column> columns;
    std::vector<std::string> plotted;  ///< columns and coordinates to plot at first; if empty, the page chooses
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
  std::vector<std::string> notes;  ///< notes on parts that are not drawn, or drawn differently
  std::vector<recording> recordings;
  std::string model;  ///< the chain as a model file in JSON, for a page that simulates; empty if files cannot hold it
  std::vector<double> q, v;  ///< initial state
};

/// The notes of a scene that name meshes and shapes that are not drawn, and why.
[[nodiscard]] std::vector<std::string> not_drawn(const scene& s);

/// The scene as JSON, "kte-scene-1". Bytes in names that are not UTF-8 become U+FFFD. Throws `bad_argument` for a scene
/// whose parts do not fit together.
[[nodiscard]] std::string to_json(const scene& s);

}  // namespace kte
