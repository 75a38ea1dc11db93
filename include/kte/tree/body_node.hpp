#pragma once

#include <kte/contract/key.hpp>
#include <kte/frames/inverse.hpp>
#include <kte/math/rigid_body.hpp>
#include <kte/tree/turn.hpp>

#include <array>
#include <cstddef>
#include <vector>

/// A chain as numbers: one body node for each moving body and the joint that moves it. Links are merged into the
/// placements of joints and frames, bodies that move together are merged, and axes are rotated to z. The algorithms of
/// this folder are loops over body nodes, each written once for all chains and scalars (docs/decisions/11-body
/// nodes.md).
namespace kte::tree {

/// The motion of a body by its joint, in the axes of the body.
enum class joint : unsigned char {
  revolute,   ///< turns about z by q
  prismatic,  ///< slides along z by q
  screw,      ///< rotates by `turns` q and slides by `slides` q
  several,    ///< several unit axes of the body: a rotation or a pose
  varying     ///< axes that depend on the coordinates, given by numbers (contract/varying_joint.hpp)
};

/// A joint and the body that it moves. The placement of the joint is in the parent body, at `position`, with the
/// rotation
///
///   R = Rz(before) Rx(tilt) Rz(after)          (1)
///
/// Every rotation is such a product (Euler angles), and the axes of a z-joint may be rotated about z at will. `before`
/// is then zero except for bodies with siblings (Khalil and Kleinfinger 1986). Two plane rotations need half the
/// operations of a matrix product, and quarter turns are exact.
template <class P>
struct body_node {
  turn<P> before, tilt, after;
  vec3<P> position{};
  P turns{}, slides{};
  joint moves = joint::revolute;
  bool turned = false;                   ///< whether `before` is not zero
  bool is_free = true;                   ///< whether its coordinate is a degree of freedom
  bool branches = false;                 ///< whether further bodies, other than the next node, are attached to it
  std::array<unsigned char, 6> axis{5};  ///< unit axes of the body: 0, 1, 2 along x, y, z; 3, 4, 5 about them
  int axes = 1;
  int parent = 0;           ///< slot: bases first, then body nodes
  int first = 0, last = 0;  ///< its own axes; they and the axes of all bodies beyond it are contiguous
  kind what = kind::gen;    ///< its coordinate: item `slot` of this kind
  int slot = 0;             ///< for several coordinates the first
  int element = -1;         ///< for `varying` the number of the joint among the elements of the chain
  /// Whether its coordinate is a single number.
  bool is_number() const { return what == kind::gen && axes == 1; }
  /// Whether its joint transform is a rotation matrix.
  bool has_matrix() const { return moves >= joint::several; }
  rigid_body<P, vec3<P>, sym3<P>> body{};   ///< the rigid body, about its centre of mass
  composite<P, vec3<P>, sym3<P>> weight{};  ///< all masses, including those with their own laws, about the origin
};

/// The place of a frame: the slot of its body, or -1 if it follows other frames, and its pose there.
template <class P>
struct frame_place {
  int slot = 0;
  pose<mat3<vec3<P>>, vec3<P>> at{};
  bool parallel = false;  ///< whether its axes are those of the body; set by `finish`
};

/// All body nodes of a chain, parents first, and the bodies beyond a node contiguous after it. Axes are numbered in
/// this order; `row[k]` is the row of axis k among the coordinates of the chain.
template <class P>
struct body_tree {
  int bases = 0;
  std::vector<body_node<P>> nodes;
  std::vector<int> row;
  std::vector<int> coordinate;  ///< by axis, for `varying` joints: the generalized coordinate
  std::vector<int> inward;      ///< body nodes inward: children before parents, siblings in order
  std::vector<composite<P, vec3<P>, sym3<P>>> base_weight;  ///< by base: the masses fixed to it
  std::array<std::vector<frame_place<P>>, 2> frames;        ///< frames in the plane and in space, by index
  bool in_order = true;                                     ///< row[k] is k for all k
  std::vector<int> varying;                                 ///< body nodes with `varying` joints
  std::size_t slots() const { return static_cast<std::size_t>(bases) + nodes.size(); }
  std::size_t axes() const { return row.size(); }
  const frame_place<P>& frame(kind k, int i) const {
    return frames[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(i)];
  }
};
/// The last body that carries both slots, which may be one of them; -1 if they have different bases.
template <class P>
int common_slot(const body_tree<P>& f, int a, int b) {
  while (a != b) {  // parents come first
    int& later = a > b ? a : b;
    if (later < f.bases) return -1;
    later = f.nodes[static_cast<std::size_t>(later - f.bases)].parent;
  }
  return a;
}

}  // namespace kte::tree
