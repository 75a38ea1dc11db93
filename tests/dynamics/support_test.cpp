#include <kte/dynamics/support.hpp>
#include <kte/elements/line_point_mindist.hpp>

#include "dynamics/small_chains.hpp"
#include "static_models/static_model.hpp"

namespace support_test {

// What moves a frame, against the columns of its Jacobian; the frames that two stand on.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

/// `moves` and the Jacobian j of a static chain, against each other and the runtime chain.
void check(const std::vector<bool>& moves, const Eigen::MatrixXd& j, const runtime_chain& c, std::string_view frame) {
  const auto at_run_time = support(c, frame);
  REQUIRE(at_run_time.size() == moves.size());
  for (std::size_t k = 0; k < moves.size(); ++k) {
    CHECK(moves[k] == !j.col(static_cast<Eigen::Index>(k)).isZero(0));
    CHECK(at_run_time[k] == moves[k]);
  }
}
template <const auto& Chain, const auto& Frame>
void check(unsigned seed) {
  random_numbers random(seed);
  const auto c = models::element_by_element(Chain);
  const auto moves = support(Chain, Frame);
  check(std::vector<bool>(moves.begin(), moves.end()), jacobian(Chain, random_configuration<double>(c, random), Frame),
        c, Frame.name);
}

TEST_CASE("what moves a frame are the columns of its Jacobian that are not zero") {
  check<floating, tip>(1);
  check<floating, aside>(2);
  check<floating, ground>(3);
  check<planar, cart>(4);
  check<geared, hand>(5);  // by a coordinate that follows another
  check<::models::tree, ::models::hand>(6);
}

TEST_CASE("common ancestors") {
  CHECK(common_ancestor(floating, tip, aside) == "body");
  CHECK(common_ancestor(floating, tip, hand) == "hand");
  CHECK(common_ancestor(floating, tip, tip) == "tip");
  CHECK(common_ancestor(floating, ground, tip) == "ground");
  const auto model = models::element_by_element(floating);
  CHECK(common_ancestor(model, "tip", "aside") == "body");
  CHECK(common_ancestor(model, model.frame("hand"), "tip") == "hand");
  CHECK(common_ancestor(model, "socket", "aside") == "body");
  runtime_chain two;
  two << base_2D("b") << revolute_joint_2D("p", "a", "x") << revolute_joint_2D("q", "b", "y");
  CHECK(common_ancestor(two, "x", "y").empty());
  CHECK_THROWS_AS(common_ancestor(model, "tip", "q1"), unknown_name);
  CHECK_THROWS_AS(support(model, "tpi"), unknown_name);
}

TEST_CASE("what moves a frame that follows another") {
  runtime_chain c;
  c << revolute_joint_2D("q1", "table", "cart") << rigid_link_2D("cart", "rail", along_x(0.75))
    << line_point_mindist_2D("rail", "near", vec2{1.0, 0.0}, vec2{0.0, 0.0}) << revolute_joint_2D("q2", "rail", "disc");
  CHECK(support(c, "near") == std::vector{true, false});
  CHECK(common_ancestor(c, "near", "disc") == "rail");
}

}  // namespace support_test
