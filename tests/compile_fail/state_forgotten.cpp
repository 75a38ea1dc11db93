// mistakes: 5
// expect: error: .*kte: algorithms on runtime chains work in a state, .*forward_dynamics.c, s, q, v, tau
// expect: error: .*kte: algorithms on runtime chains work in a state, .*inverse_dynamics.c, s, q, v, a
// expect: error: .*kte: algorithms on runtime chains work in a state, .*mass_matrix.c, s, q
// expect: error: .*kte: algorithms on runtime chains work in a state, .*jacobian.c, s, q
// expect: error: .*kte: this is the state of a static chain; a runtime chain makes its own: make_state.c
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, hand));
using numbers = std::array<double, 1>;

double a(const kte::runtime_chain& c, const numbers& x) { return kte::forward_dynamics(c, x, x, x)[0]; }
double f(const kte::runtime_chain& c, const Eigen::VectorXd& x) { return kte::inverse_dynamics(c, x, x, x)[0]; }
double m(const kte::runtime_chain& c, const numbers& x) { return kte::mass_matrix(c, x)(0, 0); }
double j(const kte::runtime_chain& c, const numbers& x) { return kte::jacobian(c, x, "hand")(0, 0); }
double other(const kte::runtime_chain& c) {
  auto s = kte::make_state(arm);
  return kte::forward_dynamics(c, s)[0];
}
