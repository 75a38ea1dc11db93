#include <kte/contact/detail/friction_in_lanes.hpp>
#include <kte/contact/friction_solver.hpp>

#include "catch.hpp"
#include "contact/friction_scenes.hpp"

namespace friction_in_lanes_test {

using namespace kte;
using test::friction_scene;
using test::friction_scenes;

using P = pack<double, 4>;

/// Problems of points at rest, one in each lane, and their solutions together.
struct problems_in_lanes {
  std::vector<friction_scene> of_lane;
  Eigen::Matrix<P, Eigen::Dynamic, Eigen::Dynamic> W;
  Eigen::Matrix<P, Eigen::Dynamic, 1> b, lambda;
  std::vector<detail::friction_contact_in_lanes<P>> contacts;
  detail::friction_in_lanes<P> solver;

  explicit problems_in_lanes(const std::vector<friction_scene>& problems) : of_lane(problems) {
    const Eigen::Index n = problems[0].b.size();
    W.resize(n, n), b.resize(n), lambda.resize(n);
    for (std::size_t lane = 0; lane < std::size_t{P::lanes}; ++lane)
      for (Eigen::Index i = 0; i < n; ++i) {
        b[i].set(lane, problems[lane].b[i]);
        for (Eigen::Index j = 0; j < n; ++j) W(i, j).set(lane, problems[lane].W(i, j));
      }
    int first = 0;
    for (const auto& c : problems[0].contacts) {
      contacts.push_back({first, c.rows, P(c.friction), P(1.0), P(0.0)});
      first += c.rows;
    }
  }
  /// The solution of a lane.
  std::vector<double> solution(std::size_t lane) const {
    std::vector<double> x;
    for (const P& force : lambda) x.push_back(force[lane]);
    return x;
  }
};

bool all_stick(const friction_solution<double>& x) {
  return std::all_of(x.modes.begin(), x.modes.end(), [](friction_mode m) { return m == friction_mode::sticks; });
}

TEST_CASE("Friction in lanes: the lanes that are solved are those whose contacts all stick") {
  friction_scenes random(3);
  friction_solver<> one;
  int solved = 0, left = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<friction_scene> scenes;
    for (std::size_t lane = 0; lane < std::size_t{P::lanes}; ++lane) scenes.push_back(random.legs(2, 4.0));
    problems_in_lanes p(scenes);
    const P good = p.solver.solve(p.W, p.b, p.contacts, p.lambda);
    for (std::size_t lane = 0; lane < std::size_t{P::lanes}; ++lane) {
      const auto& alone = one.solve(scenes[lane].problem());
      REQUIRE(alone.solved());
      CHECK((good[lane] == 1) == all_stick(alone));
      (good[lane] == 1 ? solved : left) += 1;
      if (good[lane] == 1) CHECK(test::violation(scenes[lane], p.solution(lane)) < 1e-10);
    }
  }
  CHECK(solved > 20);
  CHECK(left > 20);
}

TEST_CASE("Friction in lanes: contacts that are open in one lane leave the others unchanged") {
  friction_scenes random(5);
  std::vector<friction_scene> scenes;
  for (std::size_t lane = 0; lane < std::size_t{P::lanes}; ++lane) scenes.push_back(random.legs(2, 100.0));
  problems_in_lanes p(scenes);
  p.contacts[0].closed.set(2, 0.0);
  p.solver.solve(p.W, p.b, p.contacts, p.lambda);
  const Eigen::VectorXd both = scenes[1].W.ldlt().solve(-scenes[1].b);
  const Eigen::VectorXd second = scenes[2].W.bottomRightCorner(3, 3).ldlt().solve(-scenes[2].b.tail(3));
  for (Eigen::Index i = 0; i < 6; ++i) {
    CHECK(p.lambda[i][1] == within(both[i], 1e-10 * both.norm()));
    CHECK(p.lambda[i][2] == within(i < 3 ? 0.0 : second[i - 3], 1e-10 * second.norm()));
  }
}

}  // namespace friction_in_lanes_test
