#include <kte/manipulators/saved_manipulator.hpp>
#include <kte/manipulators/three_r_three_r.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/runtime_models.hpp>

#include "chain/models.hpp"
#include "io/all_formats.hpp"
#include "robots/iiwa14.hpp"

// Manipulators and their models in archives.

namespace saved_manipulator_test {

using namespace models;
using kte::test::contains_text, kte::test::in_all_formats, kte::test::scratch;

constexpr auto golden = pendulum.gravity(kte::along_y(-9.81));

TEST_CASE("manipulators come back from files with their tools and limits") {
  constexpr auto arm = kte::three_r_three_r();
  kte::runtime_chain c;
  c << kte::three_r_three_r_chain();
  auto limits = kte::unlimited(c);
  limits.lower[1] = -1, limits.jerk[5] = 100;
  const kte::manipulator runtime(c, {"link3", "tool"}, limits);
  in_all_formats(kte::archive().add("static", arm).add("runtime", runtime), [&](const kte::archive& b) {
    const auto one = kte::to_manipulator(b.model("static"));
    CHECK(one.tools() == std::vector<std::string>{"tool"});
    CHECK(one.limits().upper[2] == arm.limits().upper[2]);
    CHECK(one.family() == arm.family());
    const auto two = kte::to_manipulator(b.model("runtime"), models::registry());
    CHECK(two.tools() == runtime.tools());
    CHECK(two.limits() == limits);
    CHECK(kte::from_record(arm, b.model("static")).limits() == arm.limits());
    CHECK_THROWS_WITH(kte::from_record(arm, b.model("runtime")), contains_text("whose first tool is 'tool'"));
  });
  const scratch file(".xml");
  kte::save_model(file.path, arm);
  CHECK(kte::to_manipulator(kte::load_model(file.path)).limits().lower[0] == arm.limits().lower[0]);
  kte::save_model(file.path, c);
  CHECK_THROWS_WITH(kte::to_manipulator(kte::load_model(file.path)), contains_text("a chain without tools"));
}

TEST_CASE("models of manipulators: tools, limits and inputs") {
  kte::runtime_chain c;
  c << golden << kte::driving_actuator_gen("q", "motor");
  auto limits = kte::unlimited(c);
  limits.lower[0] = -1, limits.rate[0] = 2.5;
  kte::manipulator_dynamics_model moved(c);
  moved.input("motor") = 0.7;
  kte::archive a;
  a.add("arm", kte::manipulator_kinematics_model<kte::runtime_chain>(c, {"tip", "joint"})).add("moved", moved, limits);
  in_all_formats(a, [&](const kte::archive& b) {
    CHECK(b.tools("arm") == std::vector<std::string>{"tip", "joint"});
    CHECK(b.limits("moved", b.chain("moved", models::registry())) == limits);
    CHECK(b.limits("arm", c) == kte::unlimited(c));
    kte::manipulator_dynamics_model again(b.chain("moved", models::registry()));
    b.restore("moved", again);
    CHECK(again.input("motor") == 0.7);
  });
  CHECK(kte::archive().add("arm", kte::manipulator_kinematics_model(golden, tip)).tools("arm").at(0) == "tip");
  const scratch file(".json");
  kte::save_model(file.path, moved, limits);
  CHECK(kte::load_model(file.path).inputs == a.model("moved").inputs);
  CHECK(kte::limits_of(c, kte::load_model(file.path)) == limits);

  // of a static chain
  constexpr auto driven = kte::chain(golden, kte::driving_actuator_gen(q, motor));
  kte::manipulator_dynamics_model fixed(driven);
  auto of_fixed = kte::unlimited(driven);
  of_fixed.upper[0] = 0.5;
  a.add("fixed", fixed, of_fixed);
  a.restore("moved", fixed);
  CHECK(fixed.input(motor) == 0.7);
  CHECK(a.limits("fixed", driven) == of_fixed);
  const auto other = moved.with_output([](const auto&) { return Eigen::VectorXd(); });
  CHECK_THROWS_WITH(a.add("other", other), contains_text("a function of its program"));
  limits.upper[0] = -2;
  CHECK_THROWS_AS(a.add("bad", c, limits), kte::bad_parameter);
  CHECK(a.names().size() == 3);
  const auto bad = [&](kte::model_record m) {
    return kte::test::message_of<kte::error>([&] {
      kte::archive x(kte::archive_record{{{"x", m, {}}}});
      (void)x.limits("x", c), x.restore("x", moved);
    });
  };
  const auto chain = record_of(c);
  CHECK(bad({chain.gravity, chain.elements, {}, {{"elbow", {}}}}) ==
        "kte: limits of 'elbow', which is not a degree of freedom of the chain");
  CHECK(bad({chain.gravity, chain.elements, {}, {{"q", {{"upper", {1, 2}}}}}}) ==
        "kte: limits of 'q': upper must have 1 numbers, got 2");
  CHECK(bad({chain.gravity, chain.elements, {}, {{"q", {{"upper", {-1}}, {"lower", {1}}}}}}) ==
        "kte: limits of coordinate 'q': lower must not be above upper, got 1 and -1");
  CHECK(bad({chain.gravity, chain.elements, {}, {}, {{"brake", {1}}}}) == "kte: the model has no input 'brake'");
  CHECK(bad({chain.gravity, chain.elements, {}, {}, {{"motor", {1, 2}}}}) == "kte: input 'motor' has 2 numbers, not 1");
  CHECK(moved.input("motor") == 0.7);
}

TEST_CASE("limits find their coordinates, of one number or of several") {
  kte::runtime_chain c;
  c << kte::free_joint_3D("trunk", "world", "body") << kte::revolute_joint_3D("knee", "body", "shank", kte::axis::y);
  auto limits = kte::unlimited(c);
  for (std::size_t i = 0; i < 7; ++i) limits.upper[i] = 1.0 + static_cast<double>(i);
  limits.effort[6] = 30;
  const auto records = kte::limit_records(c, limits);
  REQUIRE(records.size() == 2);
  CHECK(records[0] == kte::limit_record{"trunk", {{"upper", {1, 2, 3, 4, 5, 6}}}});
  CHECK(records[1] == kte::limit_record{"knee", {{"upper", {7}}, {"effort", {30}}}});
  kte::model_record m;
  m.limits = {records[1], records[0]};
  CHECK(kte::limits_of(c, m) == limits);
}

}  // namespace saved_manipulator_test
