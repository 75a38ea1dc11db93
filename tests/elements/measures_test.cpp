#include "elements/signal_chains.hpp"

namespace measures_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::signals;

// Measures of frames and coordinates.

TEST_CASE("measures of frames: rates are derivatives of positions, in axes of the world") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    auto x = trial_of<digits50>(velocity_measure_3D("x", "y"), seed);
    const auto place = [&x](const digits50& t) {
      auto y = x;
      y.move(t);
      return y.at<0>();
    };
    CHECK(near(derivative_of([&](const digits50& t) { return place(t).position; }), x.output(), digits50("1e-30")));

    auto turned = trial_of<digits50>(rotation_measure_3D("x", "y"), seed);
    auto turns = trial_of<digits50>(ang_velocity_measure_3D("x", "y"), seed);
    const auto& u = turned.output();
    const auto R = turned.at<0>().rotation, same = matrix(u);
    CHECK(dot(u, u) <= digits50("9.8696044010893586188344909998761511353136994072408"));
    const auto& w_world = turns.output();
    turns.at<0>() = x.at<0>();
    turns.doMotion();
    const auto column = [&](int i, const auto& m) {
      return i == 0 ? transpose(m).x : i == 1 ? transpose(m).y : transpose(m).z;
    };
    for (int i = 0; i < 3; ++i) {
      CHECK(near(column(i, R), column(i, same), digits50("1e-47")));
      const auto now = column(i, x.at<0>().rotation);
      CHECK(near(derivative_of([&](const digits50& t) { return column(i, place(t).rotation); }), cross(w_world, now),
                 digits50("1e-30")));
    }
  }
  auto flat = trial_of(rotation_measure_2D("x", "y"), 1);
  flat.at<0>().rotation = rotation_by(-2.5);
  flat.doMotion();
  CHECK(flat.output() == within(-2.5, 1e-15));
  auto spin = trial_of(ang_velocity_measure_2D("x", "y"), 1);
  CHECK(spin.output() == spin.at<0>().ang_velocity);
  auto slide = trial_of(velocity_measure_2D("x", "y"), 1);
  const auto& f = slide.at<0>();
  CHECK(slide.output().x == within(f.rotation.cos * f.velocity.x - f.rotation.sin * f.velocity.y, 1e-15));
  CHECK(slide.output().z == 0);
  auto moves = trial_of(velocity_measure_gen("x", "y"), 1);
  CHECK(moves.output() == moves.at<0>().q_dot);
}

TEST_CASE("no force may depend on an accelerometer") {
  const auto all = [](const auto& name, const auto& to) {
    return to(revolute_joint_3D(name(q), name(ground), name(arm), axis::y), inertia_3D(name(arm), body),
              acceleration_measure_3D(name(arm), name(seen_a)),
              driving_actuator_3D(name(arm), name(seen_a), name(nothing)));
  };
  const auto c = all(key_itself, to_static);
  const auto x = all(text_of_key, to_runtime);
  auto s = make_state(c);
  auto t = x.make_state();
  const auto because = contains_text("measures an acceleration, on which a force depends");
  CHECK_THROWS_WITH(forward_dynamics(c, s), because);
  CHECK_THROWS_WITH(forward_dynamics(x, t), because);
  CHECK_THROWS_AS(forward_dynamics(x, t), bad_argument);
  c.doMotion(s), c.clearForce(s), c.doForce(s);
  CHECK(inverse_dynamics(c, s)[0] == within(-s[q].f, 1e-14));
  CHECK(inverse_dynamics(x, t)[0] == within(-s[q].f, 1e-14));
}

}  // namespace measures_test
