#pragma once

#include "data/problems/mechanism.hpp"

namespace kte::problems {

namespace pendulum_names {
// clang-format off
inline constexpr struct q_ final : kte::coord_key<"q"> {} q;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {} base;
inline constexpr struct rod_ final : kte::frame_2D_key<"rod"> {} rod;
inline constexpr struct bob_ final : kte::frame_2D_key<"bob"> {} bob;
// clang-format on
}  // namespace pendulum_names

/// A mass of 1 kg on a massless rod of 0.5 m, released at rest from the horizontal. q: its angle from hanging.
///
///   theta'' = -g/L sin theta,   g = 9.81 m/s^2,   with the period 1.67431709790911906837 s
struct pendulum {
  static constexpr const char* name = "pendulum";
  static constexpr long double t_end = 50L;
  static constexpr auto model = [] {
    using namespace pendulum_names;
    return chain(revolute_joint_2D(q, base, rod), rigid_link_2D(rod, bob, along_x(0.5)),
                 inertia_2D(bob, point_mass(1.0)))
        .gravity(along_x(9.81));
  }();

  template <class S>
  static joint_vector<S, 1> start_q() {
    using std::acos;
    return joint_vector<S, 1>(acos(S(0)));
  }
  template <class S>
  static joint_vector<S, 1> start_v() {
    return joint_vector<S, 1>(S(0));
  }
  /// theta, its rate
  template <class S>
  static Eigen::Matrix<S, 2, 1> output(const joint_vector<S, 1>& q, const joint_vector<S, 1>& v) {
    return {q[0], v[0]};
  }

  /// Integrated twice at 60 digits; elliptic functions agree to 37.
  static constexpr known<2> references[]{{1.0L, {-1.31124604230103985440444713261L, 3.17345019037930455188480048762L}},
                                         {10.0L, {1.55012648485020447245734548860L, 0.900570288313484916246974331733L}},
                                         {50.0L, {1.05858217161372911808916727574L, 4.38541391464584767349910112570L}}};
};

}  // namespace kte::problems
