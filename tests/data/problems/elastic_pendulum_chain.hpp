#pragma once

#include "data/problems/elastic_pendulum.hpp"
#include "data/problems/mechanism.hpp"

namespace kte::problems {

namespace elastic_pendulum_chain_names {
// clang-format off
inline constexpr struct angle_ final : kte::coord_key<"angle"> {} angle;
inline constexpr struct length_ final : kte::coord_key<"length"> {} length;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {} base;
inline constexpr struct arm_ final : kte::frame_2D_key<"arm"> {} arm;
inline constexpr struct bob_ final : kte::frame_2D_key<"bob"> {} bob;
// clang-format on
}  // namespace elastic_pendulum_chain_names

/// The elastic pendulum of data/problems/elastic_pendulum.hpp as a chain: q its angle from the horizontal and its
/// length, 1.2 m at the start.
struct elastic_pendulum_chain {
  static constexpr const char* name = "elastic pendulum as a chain";
  static constexpr long double t_end = 10L;
  static constexpr auto model = [] {
    using namespace elastic_pendulum_chain_names;
    return chain(revolute_joint_2D(angle, base, arm), prismatic_joint_2D(length, arm, bob, axis::x),
                 inertia_2D(bob, point_mass(1.0)), spring_2D(base, bob, 1.0, 100.0))
        .gravity(along_y(-9.81));
  }();

  template <class S>
  static joint_vector<S, 2> start_q() {
    return {S(0), S(S(6) / S(5))};
  }
  template <class S>
  static joint_vector<S, 2> start_v() {
    return {S(0), S(0)};
  }
  /// x, y, their rates.
  template <class S>
  static Eigen::Matrix<S, 4, 1> output(const joint_vector<S, 2>& q, const joint_vector<S, 2>& v) {
    using std::cos, std::sin;
    const S c = cos(q[0]), s = sin(q[0]), across = q[1] * v[0];
    return {S(q[1] * c), S(q[1] * s), S(v[1] * c - across * s), S(v[1] * s + across * c)};
  }

  static constexpr const auto& references = elastic_pendulum<>::references;
};

}  // namespace kte::problems
