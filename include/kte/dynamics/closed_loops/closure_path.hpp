#pragma once

#include <kte/dynamics/closed_loops/closure_motion.hpp>
#include <kte/runtime_chain/derivative_state.hpp>
#include <kte/tree/variations.hpp>

#include <vector>

/// The joints between the frames of a closure, and the derivatives of the motion of frame2 in frame1 by their
/// coordinates.
///
/// The path leads from frame1 to the body or base that carries both frames, and from there to frame2. Velocities V and
/// accelerations A of bodies are those relative to frame1: spatial vectors in the axes of frame2, at its origin. s is
/// an axis of a joint, with the opposite sign before the body that carries both; q', q'' are its rate and acceleration,
/// `before` and `after` the bodies on its sides in the order of the path.
///
///   V_after = V_before + sum s q',   A_after = A_before + sum (s q'' + V_before x s q')          (1)
///
/// Axes of a joint are constant in its body; `parent` is the body on its other side. V and A of frame2 change
///
///   by q:    dV = V_parent x s,   dA = A_parent x s + dV x (V - V_parent)          (2)
///   by q':   dV = s,              dA = V_before x s + s x (V - V_after)            (3)
///
/// and axes t that the path has passed before the body of s change by t x s.
namespace kte::detail {

/// A vector without its derivatives.
inline vec3<> values_of(const vec3<derivative_number>& x) { return {x.x.value, x.y.value, x.z.value}; }

class closure_path {
  using spatial = tree::spatial_motion<double>;

 public:
  using number = derivative_number;
  static constexpr int lanes = number::variables;
  struct axis {
    int row;  ///< of v
    spatial s;
    int joint;  ///< its number on the path
    int moves;  ///< how many axes its q moves: those of the path before its body
  };

  /// Finds the path in a tree of joints without `varying` axes, at the places of bodies and the rates and accelerations
  /// of axes in the working memory.
  void find(const runtime_state& s, const closure_place& x) {
    const closing_motion<double> m = closure_motion::motion_between(s, x);
    axes_.clear(), joints_.clear(), at_rest_ = m;
    const auto& f = s.tree().body_tree;
    columns_.resize(f.axes());
    const auto seen = closure_motion::each_relative_column(
        s, x, m, [this](int k, const tree::direction<double>& v, const tree::direction<double>& w) {
          columns_[static_cast<std::size_t>(k)] = {tree::components<double>(v), tree::components<double>(w)};
        });
    const int a = f.frame(x.frame1.what, x.frame1.index).slot, b = f.frame(x.frame2.what, x.frame2.index).slot;
    const int common = tree::common_slot(f, a, b);
    spatial v{}, acc{};
    const auto pass = [&](const spatial& rate, const spatial& acceleration) {
      acc = acc + acceleration + cross(v, rate), v = v + rate;
    };
    const auto pass_joint = [&](int slot, bool inward) {
      const auto& r = f.nodes[static_cast<std::size_t>(slot - f.bases)];
      spatial rate{}, acceleration{};
      const int first = static_cast<int>(axes_.size());
      for (int i = 0; i < r.axes; ++i) {
        const auto k = static_cast<std::size_t>(r.first + i);
        const spatial& column = columns_[k];
        rate = rate + times(s.work.rate[k], column);
        acceleration = acceleration + times(s.work.acceleration[k], column);
        axes_.push_back({f.row[k], column, static_cast<int>(joints_.size()), first});
      }
      for (auto i = static_cast<std::size_t>(first); inward && i < axes_.size(); ++i) axes_[i].moves = size();
      joint j;
      j.v_before = v, j.v_parent = v, j.a_parent = acc;
      pass(rate, acceleration);
      j.v_after = v;
      if (inward) j.v_parent = v, j.a_parent = acc;
      joints_.push_back(j);
    };
    for (int slot = a; slot >= f.bases && slot != common; slot = parent_of(f, slot)) pass_joint(slot, true);
    if (common < 0) {  // on different bases
      const auto [v1, a1] = motion_of_base(s, base_of(f, a), seen[0]);
      const auto [v2, a2] = motion_of_base(s, base_of(f, b), seen[1]);
      pass(times(-1.0, v1), times(-1.0, a1)), pass(v2, a2);
    }
    outward_.clear();
    for (int slot = b; slot >= f.bases && slot != common; slot = parent_of(f, slot)) outward_.push_back(slot);
    for (std::size_t i = outward_.size(); i-- > 0;) pass_joint(outward_[i], false);
    v_ = v, a_ = acc;
  }

  int size() const { return static_cast<int>(axes_.size()); }
  const axis& at(int i) const { return axes_[static_cast<std::size_t>(i)]; }

  /// The motion of frame2 in frame1, with the derivatives along axes from `first` on by q or v.
  closing_motion<number> motion_along(vector_of by, int first) const {
    closing_motion<number> m;
    const auto take = [](vec3<number>& to, const vec3<>& x) { to = {number(x.x), number(x.y), number(x.z)}; };
    const auto& rest = at_rest_;
    take(m.position, rest.position);
    take(m.rotation.x, rest.rotation.x), take(m.rotation.y, rest.rotation.y), take(m.rotation.z, rest.rotation.z);
    take(m.velocity, v_.linear), take(m.ang_velocity, v_.angular);
    take(m.acceleration, a_.linear + cross(v_.angular, v_.linear)), take(m.ang_acceleration, a_.angular);
    for (int lane = 0; lane < lanes && first + lane < size(); ++lane) {
      const auto k = static_cast<std::size_t>(lane);
      const auto vary = [k](vec3<number>& to, const vec3<>& x) {
        to.x.derivative[k] = x.x, to.y.derivative[k] = x.y, to.z.derivative[k] = x.z;
      };
      const axis& x = at(first + lane);
      const joint& j = joints_[static_cast<std::size_t>(x.joint)];
      spatial dv, da;
      if (by == vector_of::q) {
        dv = cross(j.v_parent, x.s), da = cross(j.a_parent, x.s) + cross(dv, minus(v_, j.v_parent));  // (2)
        vary(m.position, rest.rotation * x.s.linear);
        const auto turned = [&x](const vec3<>& row) { return cross(row, x.s.angular); };
        vary(m.rotation.x, turned(rest.rotation.x)), vary(m.rotation.y, turned(rest.rotation.y));
        vary(m.rotation.z, turned(rest.rotation.z));
      } else {
        dv = x.s, da = cross(j.v_before, x.s) + cross(x.s, minus(v_, j.v_after));  // (3)
      }
      vary(m.velocity, dv.linear), vary(m.ang_velocity, dv.angular);
      vary(m.acceleration, da.linear + (cross(dv.angular, v_.linear) + cross(v_.angular, dv.linear)));
      vary(m.ang_acceleration, da.angular);
    }
    return m;
  }
  /// Calls visit(lane, row of v) for the directions of `motion_along`.
  template <class Visit>
  void each_lane(int first, const Visit& visit) const {
    for (int lane = 0; lane < lanes && first + lane < size(); ++lane)
      visit(static_cast<std::size_t>(lane), at(first + lane).row);
  }
  /// Subtracts the derivatives of the forces of a wrench on frame2, in its axes, with the opposite one on frame1.
  /// Directions are those of `motion_along`.
  template <class Matrix>
  void subtract_forces(vector_of by, int first, const tree::dense_wrench<number>& w, Matrix& forces) const {
    const vec3<> force = values_of(w.force), torque = values_of(w.torque);
    each_lane(first, [&](std::size_t lane, int column) {
      const auto change = [lane](const vec3<number>& x) {
        return vec3<>{x.x.derivative[lane], x.y.derivative[lane], x.z.derivative[lane]};
      };
      const axis& x = at(first + static_cast<int>(lane));
      const vec3<> df = change(w.force), dt = change(w.torque);
      // (t x s) . w = t . (s x* w)
      const vec3<> moved_f = df + cross(x.s.angular, force);
      const vec3<> moved_t = dt + (cross(x.s.angular, torque) + cross(x.s.linear, force));
      const int moves = by == vector_of::q ? x.moves : 0;
      for (int i = 0; i < size(); ++i) {
        const spatial& t = at(i).s;
        forces(at(i).row, column) -=
            i < moves ? dot(t.linear, moved_f) + dot(t.angular, moved_t) : dot(t.linear, df) + dot(t.angular, dt);
      }
    });
  }

 private:
  struct joint {
    spatial v_before, v_after, v_parent, a_parent;
  };
  static spatial times(double x, const spatial& s) { return {x * s.linear, x * s.angular}; }
  static spatial minus(const spatial& a, const spatial& b) { return {a.linear - b.linear, a.angular - b.angular}; }
  template <class Tree>
  static int parent_of(const Tree& f, int slot) {
    return f.nodes[static_cast<std::size_t>(slot - f.bases)].parent;
  }
  template <class Tree>
  static int base_of(const Tree& f, int slot) {
    while (slot >= f.bases) slot = parent_of(f, slot);
    return slot;
  }
  /// The velocity and spatial acceleration of a base in the axes of a frame that has this pose in it.
  static std::pair<spatial, spatial> motion_of_base(const runtime_state& s, int base,
                                                    const tree::dense_pose<double>& x) {
    spatial v{}, a{};
    for_each_base(s, [&](const auto& m, std::size_t slot) {
      if (static_cast<int>(slot) != base) return;
      v = {as<double>(m.velocity), as<double>(m.ang_velocity)};
      a = {as<double>(m.acceleration) - cross(v.angular, v.linear), as<double>(m.ang_acceleration)};
    });
    const auto back = transpose(x.rotation);
    const auto seen = [&](const spatial& y) {
      return spatial{back * (y.linear + cross(y.angular, x.position)), back * y.angular};
    };
    return {seen(v), seen(a)};
  }

  std::vector<axis> axes_;
  std::vector<joint> joints_;
  std::vector<spatial> columns_;  ///< s, by axis of the tree
  std::vector<int> outward_;
  closing_motion<double> at_rest_{};
  spatial v_, a_;  ///< of frame2
};

}  // namespace kte::detail
