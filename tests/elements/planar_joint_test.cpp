#include <kte/elements/planar_joint.hpp>
#include <kte/io/model_file.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "elements/laws.hpp"
#include "elements/mechanism_results.hpp"

namespace planar_joint_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct puck_   final : pose_2D_key<"puck">    {} puck;
inline constexpr struct q_      final : coord_key<"q">         {} q;
inline constexpr struct ground_ final : frame_3D_key<"ground"> {} ground;
inline constexpr struct body_   final : frame_3D_key<"body">   {} body;
inline constexpr struct hand_   final : frame_3D_key<"hand">   {} hand;
inline constexpr struct table_  final : frame_2D_key<"table">  {} table;
inline constexpr struct disc_   final : frame_2D_key<"disc">   {} disc;
inline constexpr struct arm_    final : frame_2D_key<"arm">    {} arm;
// clang-format on

constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
/// On an inclined plane, with a part that moves out of it.
constexpr auto sledge = chain(planar_joint_3D(puck, ground, body), inertia_3D(body, brick),
                              revolute_joint_3D(q, body, hand, axis::x), inertia_3D(hand, brick))
                            .gravity(vec3{0.5, -1.5, -9.81});

/// Sums of some hundred products along two bodies, relative to the largest.
constexpr double few_ulps = 1e-14;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto joint = planar_joint_3D("X", "base", "end");
  CHECK(testing::motion_is_derivative<S>(joint, draw) <= by_differences<S>);
  CHECK(testing::power_is_kept<S>(joint, draw) <= rounding<S>);
}

TEST_CASE("planar joints obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("a planar joint is a free joint in the plane") {
  const auto in_space = chain(planar_joint_3D(puck, ground, body), inertia_3D(body, brick),
                              revolute_joint_3D(q, body, hand).at(along_x(0.5)), inertia_3D(hand, brick))
                            .gravity(along_y(-9.81));
  const auto brick_2D = planar_body(2.5, 0.35, vec3{0.1, -0.2, zero});
  const auto in_plane = chain(free_joint_2D(puck, table, disc), inertia_2D(disc, brick_2D),
                              revolute_joint_2D(q, disc, arm).at(along_x(0.5)), inertia_2D(arm, brick_2D))
                            .gravity(along_y(-9.81));
  random_numbers random(1);
  for (int round = 0; round < 5; ++round) {
    const some_motion m(4, 4, random);
    auto solid = results_of(in_space, hand, m.q, m.v, m.x), flat = results_of(in_plane, arm, m.q, m.v, m.x);
    flat.all[6].conservativeResize(3, 1), flat.all[6](2) = 0;
    CHECK(solid.difference_from(flat) < few_ulps);
  }
}

TEST_CASE("a planar joint is two sliding joints and a turning one") {
  // Of these p' = R v and p'' = R (a + w x v): with T = diag(R, 1), v_3 = T v and so on.
  runtime_chain three;
  three.gravity(as<double>(sledge.gravity()))
      << prismatic_joint_3D("x", "ground", "along", axis::x) << prismatic_joint_3D("y", "along", "across", axis::y)
      << revolute_joint_3D("turn", "across", "body") << inertia_3D("body", brick)
      << revolute_joint_3D("q", "body", "hand", axis::x) << inertia_3D("hand", brick);
  auto s = three.make_state();
  random_numbers random(2);
  for (int round = 0; round < 5; ++round) {
    const some_motion m(4, 4, random);
    Eigen::Matrix4d t = Eigen::Matrix4d::Identity();
    t.topLeftCorner<2, 2>() << std::cos(m.q[2]), -std::sin(m.q[2]), std::sin(m.q[2]), std::cos(m.q[2]);
    Eigen::Vector4d x = m.x;
    x[0] -= m.v[2] * m.v[1], x[1] += m.v[2] * m.v[0];
    const Eigen::VectorXd v3 = t * m.v, x3 = t * x;
    const Eigen::Vector4d tau = t.transpose() * inverse_dynamics(three, s, m.q, v3, x3);
    CHECK((inverse_dynamics(sledge, m.q, m.v, m.x) - tau).cwiseAbs().maxCoeff() < few_ulps * tau.cwiseAbs().maxCoeff());
    const Eigen::Matrix4d mass = t.transpose() * mass_matrix(three, s) * t;
    CHECK((mass_matrix(sledge, m.q) - mass).cwiseAbs().maxCoeff() < few_ulps * mass.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("planar joints: static chains, runtime chains, files") {
  CHECK(difference(sledge, models::registered(record_of(sledge)), hand, 3) < few_ulps);
  const auto placed =
      chain(planar_joint_3D(puck, ground, body).at(along_z(0.5), quarter_turn_x)).gravity(vec3{1.0, 2.0, 3.0});
  for (const auto& r : {record_of(sledge), record_of(placed)}) {
    CHECK(from_json(to_json(r)) == r);
    CHECK(from_xml(to_xml(r)) == r);
    CHECK(record_of(models::registered(r)) == r);
  }
  CHECK(record_of(from_record(placed, record_of(placed))) == record_of(placed));
  CHECK(record_of(sledge).elements[0].type == "planar_joint_3D");
  CHECK(record_of(sledge).elements[0].parameters.empty());
}

TEST_CASE("a body on a plane has the same mass wherever it is") {
  const auto at_home = mass_matrix(sledge, std::array{0.0, 0.0, 0.0, 0.5});
  const auto runtime = models::registered(record_of(sledge));
  auto s = runtime.make_state();
  for (const double angle : {3.0, 1e9, -1e300})
    for (const double far : {1e8, 1e150}) {
      const std::array q_far{far, -far, angle, 0.5};
      CHECK((mass_matrix(sledge, q_far) - at_home).cwiseAbs().maxCoeff() < few_ulps);
      CHECK((mass_matrix(runtime, s, q_far) - at_home).cwiseAbs().maxCoeff() < few_ulps);
    }
}

TEST_CASE("a planar joint keeps NaN") {
  auto x = trial_of(planar_joint_3D("X", "base", "end"), 3);
  x.at<0>().angle = not_a_number;
  x.doMotion();
  CHECK(std::isnan(x.output().rotation.x.x));
  x.at<0>() = {}, x.at<0>().position.x = not_a_number;
  x.doMotion();
  CHECK(std::isnan(x.output().position.x));
}

TEST_CASE("a planar joint wants a pose in the plane, and frames in space") {
  runtime_chain c;
  c << free_joint_3D("X", "ground", "body") << base_2D("table");
  CHECK_THROWS_WITH(c << planar_joint_3D("X", "body", "end"),
                    "kte: planar_joint_3D (coordinate 'X', base 'body', end 'end'): 'X' is a 3D pose, not a 2D pose");
  CHECK_THROWS_WITH(
      c << planar_joint_3D("Y", "table", "end"),
      "kte: planar_joint_3D (coordinate 'Y', base 'table', end 'end'): 'table' is a 2D frame, not a 3D frame");
  c << planar_joint_3D("Y", "body", "end");
  CHECK(c.dofs() == 9);
  CHECK(c.nq() == 10);
}

}  // namespace planar_joint_test
