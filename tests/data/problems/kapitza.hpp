#pragma once

#include <Eigen/Core>

#include "data/problems/error.hpp"

namespace kte::problems {

/// Kapitza's pendulum: a point on a rod of 0.5 m stands upright because its pivot shakes, 0.02 cos(300 t) m high.
///
///   theta'' = (g - a w^2 cos w t) / L sin theta,   L = 0.5, a = 0.02, w = 300, g = 9.81          (1)
///
/// with theta from upright, 0.2 at rest at the start. State: theta, its rate. Not stiff, but fast: 48 shakes a second.
/// Landau and Lifshitz, Mechanics, section 30, problem 1.
template <class S = double>
struct kapitza {
  static constexpr const char* name = "Kapitza pendulum";
  static constexpr int size = 2;
  static constexpr long double t_end = 10L;
  using state = Eigen::Matrix<S, size, 1>;

  static state start() { return state(S(S(1) / S(5)), S(0)); }
  state operator()(const S& t, const state& x) const {  // (1)
    using std::cos, std::sin;
    return state(x[1], S((S(981) / S(50) - 3600 * cos(S(300 * t))) * sin(x[0])));
  }

  /// Integrated twice at 60 digits, by extrapolation of different orders; only digits on which both agree.
  static constexpr known<2> references[4]{
      {0.1L, {0.145973388573259121091957771413L, 0.826753825473188941269705737867L}},
      {1.0L, {0.122965737606161368395123727609L, 0.417607854123808993089388317445L}},
      {5.0L, {-0.0621359975891470607442117329683L, 0.565692506127473728249710163875L}},
      {10.0L, {-0.145918493624383240572947611055L, -0.485345423257705424201384806422L}}};
  static constexpr const auto& reference = references[3].values;
};

}  // namespace kte::problems
