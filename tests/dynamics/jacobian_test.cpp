#include <kte/elements/line_point_mindist.hpp>

#include <limits>
#include <vector>

#include "data/solo12.hpp"
#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"
#include "static_models/static_model.hpp"

namespace jacobian_test {

// Jacobians: against 31 digits, against differences, static against runtime.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

/// By central differences of the pose at 50 digits: d p/dv and (dR/dv) R^T.
void check_by_differences(const model& x, const char* frame, unsigned seed, double tolerance = by_differences) {
  using vector = static_model<big>::vector3;
  using matrix = Eigen::Matrix<big, 3, 3>;
  const auto& c = x.exact;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const auto q = random_configuration<big>(x.runtime, random);
    six_by_dofs<big, Eigen::Dynamic> expected(6, c.dofs), own(6, c.dofs);
    const auto here = c.forward_kinematics(q, frame);
    for (int j = 0; j < c.dofs; ++j) {
      const static_model<big>::vector e = static_model<big>::vector::Unit(c.dofs, j);
      const auto at = [&](const big& t) { return c.forward_kinematics(c.integrate(q, e, t), frame); };
      const vector v = derivative([&](const big& t) { return vector(at(t).position); });
      const matrix r = derivative([&](const big& t) { return matrix(at(t).rotation); });
      expected.col(j) << v, vector_of_skew(matrix(r * here.rotation.transpose()));
    }
    CHECK(gap(c.jacobian_in_world_axes(q, frame), expected) < tolerance);
    own << here.rotation.transpose() * expected.topRows<3>(), here.rotation.transpose() * expected.bottomRows<3>();
    CHECK(gap(c.jacobian(q, frame), own) < tolerance);
  }
}

/// Static in double against 50 digits and against runtime. Entries are sums of a few products along at most 8 poses
/// with arms below 2 m: less than 50 roundings.
constexpr double rounding = 50 * std::numeric_limits<double>::epsilon();

void check_double(const model& x, const char* frame, unsigned seed) {
  random_numbers random(seed);
  auto s = x.runtime.make_state();
  for (int round = 0; round < 20; ++round) {
    const auto q = random_configuration<double>(x.runtime, random);
    const auto j = x.in_double.jacobian(q, frame), w = x.in_double.jacobian_in_world_axes(q, frame);
    CHECK(gap(j, x.exact.jacobian(q.cast<big>(), frame)) < rounding);
    CHECK(gap(w, x.exact.jacobian_in_world_axes(q.cast<big>(), frame)) < rounding);
    CHECK(gap(jacobian(x.runtime, s, q, frame), j) < rounding);
    CHECK(gap(jacobian(x.runtime, s, q, frame, in_world_axes), w) < rounding);
    CHECK(gap(jacobian(x.runtime, s, frame), j) < rounding);
    CHECK(gap(jacobian(x.runtime, s, frame, in_world_axes), w) < rounding);
  }
}

/// Into rows 2 to 7 of 9, whose other rows are unchanged; into a map.
template <class... Axes>
void check_parts(const runtime_chain& c, runtime_state& s, const Eigen::VectorXd& q, const char* frame, Axes... axes) {
  const runtime_jacobian expected = jacobian(c, s, q, frame, axes...);
  Eigen::MatrixXd all = Eigen::MatrixXd::Constant(9, c.dofs(), 7);
  jacobian(c, s, q, frame, axes..., all.middleRows<6>(2));
  CHECK(all.middleRows<6>(2) == expected);
  CHECK((all.topRows<2>().array() == 7).all());
  CHECK((all.bottomRows<1>().array() == 7).all());
  all.setConstant(7);
  jacobian(c, s, frame, axes..., all.middleRows(3, 6));
  CHECK(all.bottomRows<6>() == expected);
  std::vector<double> numbers(static_cast<std::size_t>(expected.size()), 7);
  Eigen::Map<runtime_jacobian> map(numbers.data(), 6, expected.cols());
  jacobian(c, s, q, frame, axes..., map);
  CHECK(map == expected);
}
/// What a matrix held before, of whatever size, leaves no trace.
void check_kept(const model& x, std::initializer_list<const char*> frames) {
  random_numbers random(21);
  const auto& c = x.runtime;
  auto s = c.make_state();
  runtime_jacobian kept = runtime_jacobian::Constant(6, 2, std::numeric_limits<double>::quiet_NaN());
  for (const char* frame : frames) {
    const auto q = random_configuration<double>(x.runtime, random);
    jacobian(c, s, q, frame, kept);
    CHECK(kept == jacobian(c, s, q, frame));
    jacobian(c, s, q, frame, in_world_axes, kept);
    CHECK(kept == jacobian(c, s, q, frame, in_world_axes));
    jacobian(c, s, frame, kept);
    CHECK(kept == jacobian(c, s, frame));
    jacobian(c, s, frame, in_world_axes, kept);
    CHECK(kept == jacobian(c, s, frame, in_world_axes));
    check_parts(c, s, q, frame), check_parts(c, s, q, frame, in_world_axes);
  }
}

TEST_CASE("Jacobian of a foot of solo12 against 31 digits") {
  // As for its other numbers (floating_base_test.cpp): a few eps of the largest.
  constexpr long double bound = 1e-15L;
  const auto& foot = robots::solo12_names::hr.foot;
  const auto model = models::element_by_element(robots::solo12);
  auto s = model.make_state();
  using by_rows = Eigen::Matrix<double, 6, 18, Eigen::RowMajor>;
  for (const auto& x : reference::solo12) {
    const by_rows j = jacobian(robots::solo12, x.q, foot, in_world_axes);
    CHECK(off(j.data(), x.foot_jacobian, 6 * 18) < bound);
    const by_rows r = jacobian(model, s, x.q, foot.name, in_world_axes);
    CHECK(off(r.data(), x.foot_jacobian, 6 * 18) < bound);
  }
}

TEST_CASE("Jacobians by differences at 50 digits") {
  check_by_differences(static_models::iiwa14(), "tool", 1);
  check_by_differences(static_models::floating(), "body", 2);
  check_by_differences(static_models::floating(), "tip", 3);
  check_by_differences(static_models::floating(), "aside", 4);
  check_by_differences(static_models::planar(), "disc", 5);
  check_by_differences(static_models::geared(), "palm", 6);
  check_by_differences(static_models::geared(), "tip", 7);
  // The axis (0.6, 0, 0.8) of the tree is a unit vector to half an eps only.
  check_by_differences(static_models::tree(), "shank", 8, 1e-15);
  check_by_differences(static_models::tree(), "hand", 9);
}

TEST_CASE("Jacobians in double, and of runtime chains") {
  check_double(static_models::iiwa14(), "tool", 11);
  check_double(static_models::floating(), "tip", 12);
  check_double(static_models::planar(), "disc", 13);
  check_double(static_models::geared(), "palm", 14);
  check_double(static_models::tree(), "shank", 15);
}

TEST_CASE("Jacobians into a matrix that is kept") {
  check_kept(static_models::floating(), {"body", "aside", "ground", "tip"});
  check_kept(static_models::geared(), {"palm", "tip"});
  // A frame that follows another: the point of a line nearest to it.
  runtime_chain c;
  c << revolute_joint_3D("q1", "ground", "a", axis::z) << prismatic_joint_3D("q2", "a", "b", axis::x)
    << line_point_mindist_3D("b", "foot", axis::x, vec3{0.0, 1.0, 0.0});
  auto s = c.make_state();
  check_parts(c, s, Eigen::Vector2d(0.25, 0.5), "foot"),
      check_parts(c, s, Eigen::Vector2d(0.25, 0.5), "foot", in_world_axes);
}

TEST_CASE("Jacobian of frames that do not move") {
  const auto q = neutral_configuration(floating);
  CHECK(jacobian(floating, q, ground).isZero(0));
  const auto j = jacobian(floating, q, aside, in_world_axes);
  CHECK(j.rightCols<1>() == Eigen::Matrix<double, 6, 1>::Unit(3));
  CHECK(j.middleCols<4>(6).isZero(0));  // the ball and the slide are on another branch
  const auto model = models::element_by_element(floating);
  auto s = model.make_state();
  CHECK(jacobian(model, s, q, "ground").isZero(0));
  CHECK(jacobian(model, s, q, "aside", in_world_axes) == j);
}

TEST_CASE("Jacobians of bad arguments") {
  const auto& c = robots::iiwa14;
  const auto& tool = robots::iiwa14_names::tool;
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  std::array<double, 7> q{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  CHECK_THROWS_AS(jacobian(c, std::vector{1.0, 2.0}, tool), bad_argument);
  CHECK_THROWS_AS(jacobian(model, s, std::array{1.0, 2.0}, "tool"), bad_argument);
  CHECK_THROWS_AS(jacobian(model, s, q, "tol"), unknown_name);
  for (std::size_t i = 0; i < 7; ++i) {
    auto bad = q;
    bad[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(jacobian(c, bad, tool), bad_argument);
    CHECK_THROWS_AS(jacobian(c, bad, tool, in_world_axes), bad_argument);
    CHECK_THROWS_AS(jacobian(model, s, bad, "tool"), bad_argument);
    runtime_jacobian kept = runtime_jacobian::Ones(6, 7);
    CHECK_THROWS_AS(jacobian(model, s, bad, "tool", in_world_axes, kept), bad_argument);
    CHECK(kept == runtime_jacobian::Ones(6, 7));
    // A matrix of wrong size is unchanged, and so is the state.
    Eigen::MatrixXd large = Eigen::MatrixXd::Ones(8, 8);
    const Eigen::VectorXd before = positions(s), other = before.array() + 1;
    const auto why = contains_text("a Jacobian of 6 x 7 does not fit into 6 x 8");
    CHECK_THROWS_WITH(jacobian(model, s, other, "tool", large.topRows<6>()), why);
    CHECK_THROWS_WITH(jacobian(model, s, "tool", in_world_axes, large.topRows<6>()), why);
    CHECK((large.array() == 1).all());
    CHECK(positions(s) == before);
  }
}

}  // namespace jacobian_test
