#pragma once

#include <kte/contract/key.hpp>
#include <kte/frames/inverse.hpp>
#include <kte/math/rigid_body.hpp>
#include <kte/tree/turn.hpp>

#include <array>
#include <cstddef>
#include <vector>

/// A chain as numbers: a body node for every moving body, with the joint that moves it. Links are folded into
/// placements of joints and places of frames, bodies that move together into one, and axes are turned to z. The
/// algorithms of this folder are loops over body nodes, each written once for all kinds of chains and scalars
/// (docs/decisions/11-body nodes.md).
namespace kte::tree {

/// How a joint moves its body, seen from the body.
enum class joint : unsigned char {
  revolute,   ///< turns about z by q
  prismatic,  ///< slides along z by q
  screw,      ///< both, by `turns` q and `slides` q
  several,    ///< several unit axes of the body at once: a rotation or a pose
  varying     ///< along axes that depend on its coordinates, which are numbers (contract/varying_joint.hpp)
};

/// A joint and the body behind it. The placement of the joint stands in the body it is on (its parent) at `position`,
/// turned by
///
///   R = Rz(before) Rx(tilt) Rz(after)          (1)
///
/// Any rotation is such a product (Euler's angles), and axes of z-joints may be turned about z at will: `before` is
/// then nothing for all bodies but those that have a brother (Khalil and Kleinfinger 1986). Two turns in a plane take
/// half the operations of a matrix, and those of quarter turns are exact.
template <class P>
struct body_node {
  turn<P> before, tilt, after;
  vec3<P> position{};
  P turns{}, slides{};
  joint moves = joint::revolute;
  bool turned = false;                   ///< whether `before` is anything
  bool is_free = true;                   ///< whether its coordinate is a degree of freedom
  bool branches = false;                 ///< whether bodies beside the next one stand on it
  std::array<unsigned char, 6> axis{5};  ///< unit axes of the body: 0, 1, 2 along x, y, z; 3, 4, 5 about them
  int axes = 1;
  int parent = 0;           ///< slot: bases come first, then body nodes
  int first = 0, last = 0;  ///< its own axes, and those of all bodies beyond it, which stand in a row
  kind what = kind::gen;    ///< its coordinate: thing `slot` of that kind
  int slot = 0;             ///< of several coordinates the first
  int element = -1;         ///< of `varying`: the number of the joint among the elements of the chain
  /// Whether its coordinate is one number.
  bool is_number() const { return what == kind::gen && axes == 1; }
  /// Whether its joint transform is a rotation matrix.
  bool has_matrix() const { return moves >= joint::several; }
  rigid_body<P, vec3<P>, sym3<P>> body{};   ///< what moves as Newton and Euler say, about its centre of mass
  composite<P, vec3<P>, sym3<P>> weight{};  ///< all masses, about the origin
};

/// Where a frame stands: in the body of a slot; in none, -1, where it follows others.
template <class P>
struct frame_place {
  int slot = 0;
  pose<mat3<vec3<P>>, vec3<P>> at{};
};

/// All body nodes of a chain, parents first and the bodies beyond one in a row behind it. Axes are numbered that way;
/// `row[k]` is the place of axis k among the coordinates of the chain.
template <class P>
struct body_tree {
  int bases = 0;
  std::vector<body_node<P>> nodes;
  std::vector<int> row;
  std::vector<int> coordinate;  ///< of the axes of `varying` joints: the generalized coordinate
  std::vector<int> inward;  ///< body nodes, those that stand on one before it, and brothers in order
  std::vector<composite<P, vec3<P>, sym3<P>>> base_weight;  ///< of what is fixed to bases
  std::array<std::vector<frame_place<P>>, 2> frames;        ///< in the plane, in space; by index
  bool in_order = true;                                     ///< row[k] is k
  std::vector<int> varying;                                 ///< body nodes with `varying` joints
  std::size_t slots() const { return static_cast<std::size_t>(bases) + nodes.size(); }
  std::size_t axes() const { return row.size(); }
  const frame_place<P>& frame(kind k, int i) const {
    return frames[k == kind::frame_2D ? 0 : 1][static_cast<std::size_t>(i)];
  }
};

}  // namespace kte::tree
