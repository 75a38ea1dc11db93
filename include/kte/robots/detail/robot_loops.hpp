#pragma once

#include <kte/elements/closures.hpp>
#include <kte/robots/detail/polynomial.hpp>
#include <kte/robots/detail/robot_elements.hpp>
#include <kte/robots/detail/robot_tree.hpp>

namespace kte::detail {

/// Appends the closures of a robot to its chain. A closure that is not at the origins of links gets separate frames.
class robot_loops {
 public:
  robot_loops(robot_elements& to, const robot_description& d, const robot_tree& tree) : to_(to), d_(d), tree_(tree) {}

  /// The name of the closure in the chain.
  std::string append(const robot_closure& c) {
    const auto loop = to_.has(c.name) ? to_.fresh(c.name + ".loop") : to_.fresh(c.name);
    if (c.is == kind::joints) return append_coupling(c, loop), loop;
    const auto a = frame(loop + ".1", c.link1, c.origin1), b = frame(loop + ".2", c.link2, c.origin2);
    switch (c.is) {
      case kind::points:
        to_.append(coincident_points_3D(loop, a, b));
        break;
      case kind::frames:
        to_.append(coincident_frames_3D(loop, a, b));
        break;
      case kind::hinge:
        to_.append(hinge_3D(loop, a, b, c.axis));
        break;
      case kind::universal:
        to_.append(universal_3D(loop, a, b, c.axis, c.axis2));
        break;
      case kind::cylindrical:
        to_.append(cylindrical_3D(loop, a, b, c.axis));
        break;
      case kind::sliding:
        to_.append(sliding_3D(loop, a, b, c.axis));
        break;
      case kind::point_on_line:
        to_.append(point_on_line_3D(loop, a, b, c.axis));
        break;
      case kind::point_on_plane:
        to_.append(point_on_plane_3D(loop, a, b, c.axis));
        break;
      case kind::distance:
        to_.append(distance_3D(loop, a, b, c.length));
        break;
      case kind::joints:
        break;
    }
    return loop;
  }

 private:
  using kind = robot_closure::kind;

  std::string frame(const std::string& name, const std::string& link, const robot_pose& place) {
    if (is_nothing(place)) return link;
    const auto own = to_.fresh(name);
    to_.append_link(link, own, place);
    return own;
  }

  /// A coordinate as a linear function of one that follows none: q = ratio q_master + offset.
  robot_joint::follower master_of(const std::string& joint) const {
    robot_joint::follower y{joint};
    while (const auto& m = d_.joints[tree_.joint(y.joint)].mimic) {
      y.offset += y.ratio * m->offset, y.ratio *= m->ratio;
      y.joint = m->joint;
    }
    return y;
  }
  /// With q_1 = r_1 x_1 + o_1 and q_2 = r_2 x_2 + o_2: r_1 x_1 + o_1 = p(r_2 x_2 + o_2).
  void append_coupling(const robot_closure& c, const std::string& loop) {
    const auto x1 = master_of(c.link1), x2 = master_of(c.link2);
    if (x1.joint == x2.joint || x1.ratio == 0)
      raise<bad_file>("kte: " + place_text(d_.source, c.line) + "'" + c.name + "' couples joints '" + c.link1 +
                      "' and '" + c.link2 + "', which follow one joint already");
    auto p = of_linear(c.polynomial, x2.ratio, x2.offset);
    p[0] -= x1.offset;
    for (auto& k : p) k /= x1.ratio;
    to_.append(coupled_by_polynomial(loop, x1.joint, x2.joint, p[0], p[1], p[2], p[3], p[4]));
  }

  robot_elements& to_;
  const robot_description& d_;
  const robot_tree& tree_;
};

}  // namespace kte::detail
