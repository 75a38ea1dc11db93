#pragma once

#include <kte/manipulators/detail/arm_coordinates.hpp>
#include <kte/manipulators/detail/wanted_pose.hpp>

#include <algorithm>

namespace kte::detail {

/// The errors of a goal, m and rad.
template <class S>
struct goal_miss {
  S linear, angular;
};

template <class P>
vec3<> finite_place(const P& position) {
  const auto p = as<double>(in_space(position));
  if (!(dot(p, p) < std::numeric_limits<double>::infinity()))
    raise<bad_argument>("kte: a desired position must be finite, as must its square, got (" + number(p.x) + ", " +
                        number(p.y) + ", " + number(p.z) + ")");
  return p;
}
template <class Weights>
Weights checked(const Weights& w) {
  if (!(w.position >= 0 && w.rotation >= 0 && w.position + w.rotation > 0 && w.position - w.position == 0 &&
        w.rotation - w.rotation == 0))
    raise<bad_argument>("kte: weights of a pose must be finite and not negative, and one of them greater than 0");
  return w;
}

template <class Arm>
inline constexpr int arm_tools = -1;
template <class Chain, key_type... Tools>
inline constexpr int arm_tools<manipulator<Chain, tool_keys<Tools...>>> = static_cast<int>(sizeof...(Tools));

template <class Arm, class Tool>
struct tool_place;
template <class Chain, key_type... Tools, class Tool>
struct tool_place<manipulator<Chain, tool_keys<Tools...>>, Tool> {
  static constexpr std::size_t value = [] {
    constexpr bool same[]{std::is_same_v<Tools, Tool>...};
    std::size_t i = 0;
    while (i < sizeof...(Tools) && !same[i]) ++i;
    return i;
  }();
  static_assert(value < sizeof...(Tools), "kte: this manipulator has no tool of this name");
};

/// A manipulator at a configuration: the poses and Jacobians of its tools.
template <class Arm, class S>
class arm_at {
 public:
  using scalar = S;
  static constexpr int n = arm_dofs<Arm>, rows = arm_tools<Arm> < 0 ? -1 : 6 * arm_tools<Arm>;
  using configuration = joint_vector<S, arm_numbers<Arm>>;

  arm_at(const Arm& a, const configuration& at, const S& l) : arm(a), length(l), q(at) {
    if constexpr (arm_tools<Arm> < 0) poses.resize(a.tools().size());
    move(at);
  }
  void move(const configuration& to) {
    q = to;
    const auto found = arm.getDependentPoses(q);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = spatial(found[i]);
  }
  void differentiate() { jacobian = arm.getJacobianMatrix(q); }

  template <class Tool>
  std::size_t index_of(const Tool& tool) const {
    if constexpr (arm_tools<Arm> >= 0) {
      return tool_place<Arm, Tool>::value;
    } else {
      const auto& names = arm.tools();
      const auto found = std::find(names.begin(), names.end(), tool);
      if (found == names.end()) throw unknown_name("kte: the manipulator has no tool '" + tool + "'");
      return static_cast<std::size_t>(found - names.begin());
    }
  }

  const Arm& arm;
  S length;  ///< m per rad in errors
  configuration q;
  std::conditional_t<(arm_tools<Arm> < 0), std::vector<pose<mat3<vec3<S>>, vec3<S>>>,
                     std::array<pose<mat3<vec3<S>>, vec3<S>>, std::size_t(arm_tools<Arm> < 0 ? 0 : arm_tools<Arm>)>>
      poses;
  Eigen::Matrix<S, rows, n> jacobian;
};

/// Half the weighted sum of squares of all errors of goals; and with derivatives
///
///   g = J^T W e,   H = J^T W J                                                        (1)
template <class S>
struct sum_of_squares {
  S half = S(0);
  template <class Row>
  void operator()(const S& e, const S& w, const Row&) {
    half += w * e * e / S(2);
  }
};
template <class S, int N>
struct normal_equations {
  explicit normal_equations(Eigen::Index n)
      : h(joint_matrix<S, N>::Zero(n, n)), g(joint_vector<S, N>::Zero(n)), row_(n) {}
  template <class Row>
  void operator()(const S& e, const S& w, const Row& row) {
    for (Eigen::Index k = 0; k < g.size(); ++k) row_[k] = row(k);
    for (Eigen::Index k = 0; k < g.size(); ++k) {
      const S weighted = w * row_[k];
      g[k] += weighted * e;
      for (Eigen::Index i = k; i < g.size(); ++i) h(i, k) += weighted * row_[i];
    }
    half += w * e * e / S(2);
  }
  S half = S(0);
  joint_matrix<S, N> h;  // only the lower triangle
  joint_vector<S, N> g;

 private:
  joint_vector<S, N> row_;
};

}  // namespace kte::detail
