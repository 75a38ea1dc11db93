#include <kte/manipulators/inverse_kinematics.hpp>
#include <kte/math/dual.hpp>

#include "manipulators/six_axes.hpp"

namespace arm_families_test {

using namespace kte;
using namespace arms;
using test::says;

// Which closed form an arm has: fewer axes or more, none, families that agree, and branches.

TEST_CASE("planar arms and SCARA") {
  const manipulator planar(planar_3R(), "tool"), four(scara(), "tool");
  CHECK(planar.family() == arm_family::planar_3R);
  CHECK(four.family() == arm_family::scara);
  random_numbers random(8);
  for (int k = 0; k < 2000; ++k)
    for (const auto* arm : {&planar, &four}) {
      const auto r = check_answers(*arm, random_posture(random, arm->dofs()));
      CHECK(r.exact == 2);
      CHECK(r.position <= 1e-14);
      CHECK(r.rotation <= 1e-14);
      CHECK(r.found <= 1e-9);
    }
}

TEST_CASE("arms without a closed form say what their axes miss") {
  const auto no = [](const runtime_chain& c, const char* text) {
    const manipulator arm(c, "tool");
    CHECK(arm.family() == arm_family::none);
    CHECK_THROWS_MATCHES(inverse_kinematics(arm, arm.getDependentPoses(numbers::Zero(arm.dofs()))[0]), no_closed_form,
                         says(text));
  };
  no(chain(none, {{e_z, {0, 0, 1}},
                  {e_y, {1, .1, .1}},
                  {e_x, {0, 0, .5}},
                  {e_z, {0, 1e-4, .5}},
                  {e_y, {0, 0, 0}},
                  {e_z, none}}),
     "axes 4, 5, 6 pass within");
  no(chain(none, {{e_z, {0, 0, 1}},
                  {e_y, {1, .1, .1}},
                  {e_y, {0, .1, .5}},
                  {{std::sin(1e-5), std::cos(1e-5), 0}, {0, 1e-4, .5}},
                  {e_z, {.1, 0, 0}},
                  {e_x, none}}),
     "axes 3, 4, 5 are 1.5707963267948");
  no(chain(none, {{e_z, {0, 0, 1}}, {e_y, none}}), "for an arm of 2 joints that turn");
  no(chain(none, {{e_z, {0, 0, 1}}, {e_y, {1, 0, 0}}, {e_y, none}}), "whose axes are not parallel");
}

TEST_CASE("seven axes without an arm angle: the first or last joint is held") {
  const std::vector<named_arm> all{{"Panda", manipulator(arms::panda(), "tool"), arm_family::offset_7R, 6},
                                   {"ERA", manipulator(arms::era(), "tool"), arm_family::offset_7R, 7},
                                   {"SSRMS", manipulator(arms::ssrms(), "tool"), arm_family::offset_7R, 6}};
  for (const auto& a : all) {
    INFO(a.name);
    CHECK(a.arm.family() == a.family);
    const int held = a.arm.structure().held;
    const std::string name = "q" + std::to_string(held + 1);
    random_numbers random(9);
    const int count = 1000;
    int exact = 0;
    for (int k = 0; k < count; ++k) {
      const auto q = random_posture(random, 7);
      const auto r = check_answers(a.arm, q, locked(name, q[held]));
      CHECK(r.position <= 1e-14);
      CHECK(r.rotation <= 1e-14);
      CHECK(r.found <= 1e-7);
      exact += r.exact;
    }
    CHECK(exact >= a.least * count);
  }
  const auto& arm = all[0].arm;
  const auto x = arm.getDependentPoses(numbers::Zero(7))[0];
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, x, locked("q3", 0.1)), no_closed_form, says("with 'q3' locked"));
  CHECK_THROWS_MATCHES(inverse_kinematics(arm, x, locked("q9", 0.1)), unknown_name, says("'q9'"));
  CHECK_THROWS_AS(inverse_kinematics(arm, x, locked("q7", NAN)), bad_argument);
}

TEST_CASE("the formulas of degree four agree with those of parallel axes on arms that fit both") {
  const auto& arm = six_axes()[1].arm;
  auto general = arm.structure();
  general.form = detail::closed_form::wrist_general;
  auto parallel = six_axes()[2].arm.structure();
  auto mixed = parallel;
  mixed.form = detail::closed_form::parallel_general;
  random_numbers random(10);
  const auto compare = [&](const detail::arm_structure& a, const detail::arm_structure& b) {
    detail::by_joint<double> q{};
    for (std::size_t i = 0; i < 6; ++i) q[i] = random(M_PI);
    const auto x = detail::tool_pose(a.original, q);
    const auto one = detail::solve_closed_form<double>(a, x, {}, 0.0),
               two = detail::solve_closed_form<double>(b, x, {}, 0.0);
    for (std::size_t i = 0; i < one.at.size; ++i) {
      if (detail::gap_between(detail::tool_pose(a.original, one.at.posture(i)), x).position > 1e-9) continue;
      double nearest = 10;
      for (std::size_t k = 0; k < two.at.size; ++k) {
        double far = 0;
        for (std::size_t j = 0; j < 6; ++j) far = std::max(far, turn_between(one.at.t[j][i], two.at.t[j][k]));
        nearest = std::min(nearest, far);
      }
      CHECK(nearest < 1e-6);
    }
  };
  for (int k = 0; k < 300; ++k) compare(arm.structure(), general), compare(parallel, mixed);
}

TEST_CASE("branches go on along a path, and derivatives are those of the Jacobian") {
  const auto& arm = six_axes()[1].arm;
  numbers q(6), v(6);
  q << 0.3, 0.4, -0.7, 0.9, 0.6, 0.5;
  v << 0.3, -0.2, 0.4, 0.6, 0.3, -0.7;
  std::vector<numbers> last;
  for (int k = 0; k < 200; ++k, q += 2e-3 * v) {
    const auto all = inverse_kinematics(arm, arm.getDependentPoses(q)[0]);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (k > 0) CHECK(distance(all[i].q, last[i]) < 0.05);
      CHECK(all[i].branch == i);
    }
    last.clear();
    for (const auto& a : all) last.push_back(a.q);
  }
  // Along a twist in axes of the world: q' = J^-1 twist.
  using number = dual<double, 1>;
  const auto x = arm.getDependentPoses(q)[0];
  const vec3<> u{0.2, -0.4, 0.7}, w{-0.5, 0.3, 0.1};
  const auto turning = as<double>(cross_matrix(w) * x.rotation);
  const pose goal{mat3<vec3<number>>{moving(x.rotation.x, turning.x), moving(x.rotation.y, turning.y),
                                     moving(x.rotation.z, turning.z)},
                  moving(x.position, u)};
  for (const auto& a : inverse_kinematics(arm, goal)) {
    numbers rates(6), at(6);
    for (Eigen::Index i = 0; i < 6; ++i) at[i] = a.q[i].value, rates[i] = a.q[i].derivative[0];
    const numbers twist = arm.getJacobianMatrix(at) * rates;
    const double wanted[]{u.x, u.y, u.z, w.x, w.y, w.z};
    for (Eigen::Index i = 0; i < 6; ++i) CHECK(twist[i] == within(wanted[i], 1e-12));
  }
}

TEST_CASE(
    "equations of degree four: the sign of the determinant, and what is behind them, name branches along a path") {
  for (const std::size_t which : {3u, 4u}) {
    const auto& arm = six_axes()[which].arm;
    const unsigned lasting = which == 3 ? 1 | 4 : 1 | 2;  // not which of those of one sign
    random_numbers random(11);
    int compared = 0;
    for (int path = 0; path < 20; ++path) {
      numbers q = random_posture(random, 6);
      const numbers v = random_posture(random, 6) / 3;
      auto last = inverse_kinematics(arm, arm.getDependentPoses(q)[0]);
      for (int k = 0; k < 50; ++k) {
        q += 1e-3 * v;
        const auto all = inverse_kinematics(arm, arm.getDependentPoses(q)[0]);
        for (const auto& a : all) {
          CHECK((a.branch < 8 || !a.exact));  // two of each sign
          for (const auto& b : all)
            if (&a != &b && a.exact && b.exact) CHECK((a.branch != b.branch || distance(a.q, b.q) < 1e-6));
          const ik_answer<numbers>* same = nullptr;
          for (const auto& b : last)
            if (a.exact && b.exact && distance(a.q, b.q) < 0.01) same = same == nullptr ? &b : &a;  // of two none
          if (same == nullptr || same == &a) continue;
          CHECK((a.branch & lasting) == (same->branch & lasting));
          ++compared;
        }
        last = all;
      }
    }
    CHECK(compared > 3000);
  }
}

}  // namespace arm_families_test
