#include <kte/dynamics/closed_loops/statics.hpp>

#include "catch.hpp"
#include "closed_loops/tangle.hpp"
#include "random.hpp"

namespace statics_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using Catch::Matchers::Message;

TEST_CASE("a parallelogram falls to its lower equilibrium and swings there with its natural frequency") {
  for (const bool twice : {false, true}) {
    const auto c = four_bars(2, twice);
    auto s = c.make_state();
    const auto r = static_equilibrium(c, s, four_bar_q(2, 2.0), actuated("q0"));
    CHECK(r.status == equilibrium_status::stable);
    CHECK(std::remainder(r.q[0] + pi / 2, 2 * pi) == within(0, 1e-10));
    CHECK(kte::loops(c, s, r.q).gap < 1e-14);
    const auto modes = natural_modes(c, s, r.q, actuated("q0"));
    CHECK(modes.frequency.size() == 1);
    CHECK(modes.frequency[0] == within(std::sqrt(four_bar_constant(2)), 1e-9));
    CHECK(modes.damping[0] == within(0, 1e-12));
    const auto top = static_equilibrium(c, s, four_bar_q(2, 0), actuated("q0"));
    CHECK(top.status == equilibrium_status::unstable);
    CHECK_THROWS_AS(natural_modes(c, s, four_bar_q(2, 0.5), actuated("q0")), bad_argument);
  }
}

TEST_CASE("an equilibrium of loops with springs has no acceleration, and its modes are those of differences") {
  auto c = four_bars(1);
  c << torsion_spring_2D("base", "b0", 30.0) << damper_gen("q0", "c0", 0.2);
  auto s = c.make_state();
  const auto r = static_equilibrium(c, s, four_bar_q(1, 0.9), actuated("q1"));
  const vector none = vector::Zero(3);
  CHECK(constrained_dynamics(c, s, r.q, none, none).a.cwiseAbs().maxCoeff() < 1e-8);
  CHECK(r.status == equilibrium_status::stable);
  const auto modes = natural_modes(c, s, r.q, actuated("q1"));
  const auto linear = actuated_dynamics_derivatives(c, s, r.q, none, none, actuated("q1"));
  CHECK(modes.frequency[0] == within(std::sqrt(-linear.by_q(0, 0)), 1e-10));
  CHECK(modes.damping[0] == within(-linear.by_v(0, 0) / (2 * modes.frequency[0]), 1e-10));
  CHECK(modes.damping[0] > 1e-3);
}

TEST_CASE("hybrid dynamics with closures solves for what is not known") {
  random_numbers draw(9);
  tangle x;
  x.closed << coincident_points_3D("l", "lb", "re") << coupled_coordinates("n", "l1", "l3", 1.0, 1.0);
  const auto drawn = [&] { return vector::NullaryExpr(x.open.dofs(), [&] { return draw(); }).eval(); };
  auto s = x.closed.make_state();
  const vector q = integrate(x.open, neutral_configuration(x.open), drawn(), 1.0), v = drawn(), known = drawn();
  const auto r = hybrid_dynamics(x.closed, s, q, v, known, {"l2", "r1"});
  const double force = s.loop("l").force.x, torque = s.loop("n").torque.x;
  int prescribed = 0;
  for (const auto& f : layout(x.closed))
    for (int k = f.v; k < f.v + f.nv; ++k) {
      const bool given = f.name == "l2" || f.name == "r1";
      prescribed += given;
      CHECK((given ? r.a : r.tau)[k] == known[k]);
    }
  CHECK(prescribed == 4);
  const auto all = constrained_dynamics(x.closed, s, q, v, r.tau);
  CHECK((all.a - r.a).cwiseAbs().maxCoeff() < 1e-11 * (1 + r.a.cwiseAbs().maxCoeff()));
  CHECK(all.loop("l").force.x == within(force, 1e-10 * (1 + std::abs(force))));
  CHECK(all.loop("n").torque.x == within(torque, 1e-10 * (1 + std::abs(torque))));

  const auto c = four_bars(1);
  auto t = c.make_state();
  const vector on = four_bar_q(1, 0.7), rate = four_bar_v(1, 1.0);
  CHECK_THROWS_MATCHES(hybrid_dynamics(c, t, on, rate, numbers({1, 2, 0}), {"q0", "q1"}), bad_argument,
                       Message("kte: hybrid_dynamics: the closures do not allow this acceleration of 'q0' with the "
                               "others that are prescribed"));
  const auto both = hybrid_dynamics(c, t, on, rate, numbers({1, 1, 0}), {"q0", "q1"});  // all that it can do
  CHECK(both.a[2] == within(-1, 1e-12));
}

}  // namespace statics_test
