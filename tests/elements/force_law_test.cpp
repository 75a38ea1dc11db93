#include <kte/dynamics.hpp>
#include <kte/static.hpp>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace force_law_test {

using namespace kte;
using namespace kte::test;

const auto spring_law = [](const auto& c) { return -3.0 * c.q - 0.5 * c.q_dot * c.q_dot; };
const auto keel = [](const auto& x) { return vec3{zero, -40.0 * x.velocity.y, zero}; };
/// A spring to the origin, and a torque against turning.
const auto tether = [](const auto& x) {
  return wrench{transpose(x.rotation) * (-2.0 * x.position), -5.0 * x.ang_velocity};
};

TEST_CASE("forces by functions are what these say") {
  auto c = trial_of(force_law_gen("q", spring_law), 1);
  c.at<0>() = {.q = 2, .q_dot = 4};
  c.doForce();
  CHECK(c.at<0>().f == -14.0);
  auto flat = trial_of(force_law_2D("hull", keel), 1);
  flat.at<0>().velocity = {1, 2};
  flat.doForce();
  CHECK(flat.at<0>().force == vec2{0.0, -80.0});
  CHECK(flat.at<0>().torque == 0.0);
  auto solid = trial_of(force_law_3D("kite", tether), 1);
  solid.at<0>().rotation = as<double>(quarter_turn_z);
  solid.at<0>().position = {1, 2, 3}, solid.at<0>().ang_velocity = {0, 1, 0};
  solid.doForce();
  CHECK(solid.at<0>().force == vec3{-4.0, 2.0, -6.0});
  CHECK(solid.at<0>().torque == vec3{0.0, -5.0, 0.0});
  random_numbers draw(1);
  CHECK(testing::force_is_gradient<digits50>(
            force_law_3D("kite", [](const auto& x) { return transpose(x.rotation) * (-2.0 * x.position); }), draw,
            [](const auto& x) { return dot(x.position, x.position); }) <= 10 * by_differences<digits50>);
}

TEST_CASE("forces by functions act in static and in runtime chains, with derivatives") {
  // clang-format off
  static constexpr struct q_    final : coord_key<"q">       {} q;
  static constexpr struct base_ final : frame_3D_key<"base"> {} base;
  static constexpr struct kite_ final : frame_3D_key<"kite"> {} kite;
  // clang-format on
  const auto c = chain(prismatic_joint_3D(q, base, kite, axis::x), inertia_3D(kite, point_mass(2.0)),
                       force_law_gen(q, spring_law), force_law_3D(kite, tether));
  const std::array x{0.5}, v{0.25}, a{0.0};
  CHECK(inverse_dynamics(c, x, v, a)[0] == within(5 * 0.5 + 0.5 * 0.0625, 4 * eps<double>));
  runtime_chain runtime;
  runtime << prismatic_joint_3D("q", "base", "kite", axis::x) << inertia_3D("kite", point_mass(2.0))
          << force_law_gen("q", spring_law) << force_law_3D("kite", tether);
  auto s = runtime.make_state();
  const auto& d = inverse_dynamics_derivatives(runtime, s, x, v, a);
  CHECK(d.tau[0] == within(5 * 0.5 + 0.5 * 0.0625, 4 * eps<double>));
  CHECK(d.by_q(0, 0) == within(5, 4 * eps<double>));
  CHECK(d.by_v(0, 0) == within(0.25, 4 * eps<double>));
  CHECK_THROWS_MATCHES(record_of(runtime), bad_argument,
                       says("kte: force_law_gen (coordinate 'q') holds a function of its program"));
}

}  // namespace force_law_test
