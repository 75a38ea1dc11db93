#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/static.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace fluid_drag_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_    final : coord_key<"q">       {} q;
inline constexpr struct base_ final : frame_3D_key<"base"> {} base;
inline constexpr struct body_ final : frame_3D_key<"body"> {} body;
// clang-format on

template <class S>
void check_laws() {
  random_numbers draw(1);
  const S c = S(7) / 3;
  CHECK(testing::no_work_done<S>(fluid_drag_2D("a", c, S(2)), draw) == 0);
  CHECK(testing::no_work_done<S>(fluid_drag_3D("a", c, S(2)), draw) == 0);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    auto x = trial_of<S>(fluid_drag_3D("a", c, S(2), vec3{c, S(-1), S(3)}), seed);
    const auto& f = x.template at<0>();
    x.doForce();
    // Forces are up to 70 N.
    const vec3<S> u = f.rotation * f.velocity - vec3{c, S(-1), S(3)};  // in the world
    using std::sqrt;
    CHECK(near(f.rotation * f.force, S(-(c * sqrt(dot(u, u)) + S(2))) * u, S(70 * rounding<S>)));
  }
}

TEST_CASE("drag obeys the laws") { check_laws<double>(), check_laws<digits50>(); }

TEST_CASE("drag by its formula") {
  const auto force = [](const vec2<>& v, auto... numbers) {
    auto x = trial_of(fluid_drag_2D("a", numbers...), 1);
    x.template at<0>() = {.rotation = {0, 1}, .velocity = v};  // a quarter turn
    x.doForce();
    CHECK(x.template at<0>().torque == 0);
    return x.template at<0>().force;
  };
  CHECK(force({3, 4}, 2.0) == vec2{-30.0, -40.0});
  CHECK(force({3, 4}, 2.0, 1) == vec2{-33.0, -44.0});
  CHECK(force({3, 4}, zero, 2.0) == vec2{-6.0, -8.0});
  CHECK(force({3, 4}, 2.0, zero, vec2{-4.0, 3.0}) == vec2{-0.0, -0.0});  // carried along
  CHECK(force({0, 0}, 2.0, 1.0) == vec2{-0.0, -0.0});
  CHECK(force({0, 0}, 2.0, zero, along_x(1.0)) == vec2{0.0, -2.0});  // blown along x of the world, its -y
  CHECK(std::isnan(force({not_a_number, 0}, 2.0).x));
}

TEST_CASE("a body falls through the air at its terminal speed in the end") {
  // v = v_t tanh(g t/v_t), v_t^2 = m g/c;  fallen v_t^2/g ln cosh(g t/v_t)
  constexpr double m = 3, c = 0.02, g = 9.81, t = 5;
  const auto fall =
      chain(prismatic_joint_3D(q, base, body, axis::z), inertia_3D(body, point_mass(m)), fluid_drag_3D(body, c))
          .gravity(along_z(-g));
  const manipulator_dynamics_model model(fall);
  dormand_prince45 solver(std::cref(model), 0.0, model.make_x(std::array{0.0}, std::array{0.0}),
                          {.absolute = 1e-12, .relative = 1e-12});
  solver.integrate(t);
  const double v_t = std::sqrt(m * g / c);
  CHECK(solver.state()[1] == within(-v_t * std::tanh(g * t / v_t), 1e-9));
  CHECK(solver.state()[0] == within(-v_t * v_t / g * std::log(std::cosh(g * t / v_t)), 1e-9));
}

TEST_CASE("drag is saved and loaded, and rejects invalid input") {
  runtime_chain chain;
  chain << base_2D("a") << fluid_drag_2D("a", 1.0, 2.0, vec2{3.0, 4.0}) << base_3D("b") << fluid_drag_3D("b", 5.0);
  CHECK(record_of(models::registered(record_of(chain))) == record_of(chain));
  const std::string where = "kte: fluid_drag_3D (frame 'a'): ";
  CHECK(complaint([] { (void)fluid_drag_3D("a", -1); }) ==
        where + "quadratic drag must be finite and not negative, got -1");
  CHECK(complaint([] { (void)fluid_drag_3D("a", 1, -1); }) ==
        where + "linear drag must be finite and not negative, got -1");
  CHECK(complaint([] { (void)fluid_drag_3D("a", 1, 1, along_x(infinity)); }) == where + "flow must be finite, got inf");
}

}  // namespace fluid_drag_test
