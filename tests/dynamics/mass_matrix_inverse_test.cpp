
#include "digits50.hpp"
#include "dynamics/inverse_error.hpp"

// The inverse of the mass matrix where coordinates follow others, at 50 digits, and if there is none.

namespace mass_matrix_inverse_test {

using namespace kte;
using namespace kte::test::trees;

constexpr auto shared =
    chain(revolute_joint_3D(q1, base, a, axis::y), inertia_3D(a, body), prismatic_joint_3D(q2, a, b, axis::x),
          inertia_3D(b, light), revolute_joint_3D(q1, b, d, oblique), inertia_3D(d, light))
        .gravity(fall);

TEST_CASE("the inverse of the mass matrix where coordinates follow others") {
  STATIC_REQUIRE(!by_articulated_bodies<decltype(models::tree)>);
  check_inverse(models::tree, 4, models::ground, models::wall, models::motor);
  STATIC_REQUIRE(!by_articulated_bodies<decltype(shared)>);
  check_inverse(shared, 5, base);
}

TEST_CASE("the inverse of a mass matrix that is known") {
  // M = (2, 1; 1, 1.5), and 4 alone
  constexpr auto motors = chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(1.0, 1.0)),
                                revolute_joint_2D(q2, k, l), inertia_2D(l, planar_body(1.0, 1.0)), inertia_gen(q2, 0.5),
                                inertia_gen(lone, 4.0), spring_gen(lone, q1, 0.5, 10.0), damper_gen(lone, q2, 3.0))
                              .gravity(along_y(-9.81));
  joint_matrix<double, 3> exact;
  exact << 0.75, -0.5, 0, -0.5, 1, 0, 0, 0, 0.25;
  CHECK(gap(mass_matrix_inverse(motors, std::array{0.5, -0.75, 2.0}), exact) < 1e-15);
  // one on a slide of 3 kg given by hand: M = 2 + 3 (1 + x)^2
  constexpr auto reached =
      chain(base_gen(drive), revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(1.0, 2.0)),
            rigid_link_2D(k, l, along_x(1.0)), prismatic_joint_2D(drive, l, m, axis::x), inertia_2D(m, point_mass(3.0)))
          .gravity(along_y(-9.81));
  auto s = make_state(reached);
  s[drive] = {1.0, 5.0, -7.0};
  s[q1].q = 0.5;
  CHECK(mass_matrix_inverse(reached, s)(0, 0) == within_relative(1.0 / 14, 1e-15));
  // where no state is, it is at 0
  CHECK(mass_matrix_inverse(reached, std::array{0.5})(0, 0) == within_relative(1.0 / 5, 1e-15));
}

TEST_CASE("the inverse of the mass matrix at 50 digits") {
  using big = kte::test::digits50;
  constexpr auto c = chain(prismatic_joint_3D(q1, base, a, axis::y), inertia_3D(a, body),
                           spherical_joint_3D(ball, a, b), inertia_3D(b, light), inertia_gen(q1, 0.5));
  const std::array<big, 5> q{big(1) / 3, big(1) / 2, big(1) / 7, big(-2) / 3, big(1) / 5};
  const auto inverse = mass_matrix_inverse(c, q);
  const joint_matrix<big, 4> none = mass_matrix(c, q) * inverse - joint_matrix<big, 4>::Identity();
  CHECK(largest(none) < 1e-47);
}

TEST_CASE("mass matrices without an inverse") {
  const auto throws = [](const auto& c) {
    const joint_vector<double, std::remove_cvref_t<decltype(c)>::nq> q = decltype(q)::Constant(0.25);
    CHECK_THROWS_AS(mass_matrix_inverse(c, q), singular_mass_matrix);
    CHECK_THROWS_WITH(mass_matrix_inverse(c, q), test::contains_text("kte: the mass matrix is singular: '"));
    auto s = make_state(c);
    CHECK_THROWS_AS(mass_matrix_inverse(c, s), singular_mass_matrix);
  };
  throws(chain(revolute_joint_3D(q1, base, a)));
  throws(chain(revolute_joint_3D(q1, base, a, oblique), revolute_joint_3D(q2, a, c, oblique), inertia_3D(c, body)));
  throws(chain(free_joint_3D(floating, base, a), inertia_3D(a, point_mass(1.0))));
  throws(chain(revolute_joint_3D(q1, base, a), inertia_3D(a, body), inertia_gen(lone, 0.0)));
  throws(chain(rigid_link_gen(q1, lone, 0.5), revolute_joint_3D(lone, base, a), inertia_3D(a, point_mass(1.0))));
}

TEST_CASE("the inverse of the mass matrix of arguments that are not finite") {
  constexpr auto c = chain(base_gen(drive), revolute_joint_3D(q1, base, a), inertia_3D(a, body),
                           prismatic_joint_3D(drive, a, b, axis::x), spherical_joint_3D(ball, b, d),
                           inertia_3D(d, body), prismatic_joint_3D(q2, d, e, axis::z), inertia_3D(e, light));
  STATIC_REQUIRE(by_articulated_bodies<decltype(c)>);
  const std::array good{0.25, 0.5, 0.125, -0.5, 0.75, 0.5};
  CHECK_NOTHROW(mass_matrix_inverse(c, good));
  auto s = make_state(c);
  const auto rejected = [&](const auto& chain_, auto& state, const auto& q, const std::string& what) {
    CHECK_THROWS_AS(mass_matrix_inverse(chain_, q), bad_argument);
    CHECK_THROWS_WITH(mass_matrix_inverse(chain_, q), kte::test::contains_text(what));
    set_positions(state, q);
    CHECK_THROWS_WITH(mass_matrix_inverse(chain_, state), kte::test::contains_text(what));
  };
  const std::string no_number = "kte: a coordinate is not finite: q[";
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    for (std::size_t i = 0; i < good.size(); ++i) {
      auto q = good;
      q[i] = bad;
      rejected(c, s, q, no_number);
    }
    auto t = make_state(shared);
    rejected(shared, t, std::array{bad, 0.5}, no_number);
    // what is given
    set_positions(s, good);
    s[drive].q = bad;
    CHECK_THROWS_MATCHES(mass_matrix_inverse(c, s), bad_argument, kte::test::says("not finite"));
    s[drive].q = 0;
  }
  rejected(c, s, std::array{0.25, 0.0, 0.0, 0.0, 0.0, 0.5}, "kte: quaternion 'ball' has length 0");
  CHECK_THROWS_WITH(mass_matrix_inverse(c, std::vector{0.25, 0.5}),
                    "kte: q has 2 numbers, the chain has 6 numbers of a configuration");
}

}  // namespace mass_matrix_inverse_test
