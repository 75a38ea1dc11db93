#include <kte/view/pull.hpp>

#include "view/live_pages.hpp"

namespace live_pull_test {

using namespace kte;
using namespace kte::test;

/// Two pendulums in the plane that can be pulled.
struct pulled_pendulums {
  page_pull hand;
  runtime_chain chain;

  pulled_pendulums() {
    runtime_chain c;
    c.gravity(along_y(-9.81));
    c << revolute_joint_2D("q", "base", "joint") << rigid_link_2D("joint", "tip", along_x(0.5))
      << inertia_2D("tip", point_mass(1.0)) << revolute_joint_2D("p", "tip", "arm")
      << rigid_link_2D("arm", "end", along_x(0.5)) << inertia_2D("end", point_mass(3.0));
    chain = with_pulls(c, hand);
  }
};
std::string request(const std::string& frame, const std::string& x, const std::string& to_y) {
  return "pull?frame=" + frame + "&x=" + x + "&y=0&z=0&to_x=0.5&to_y=" + to_y + "&to_z=0";
}

TEST_CASE("the scene of a chain that pages may pull") {
  const pulled_pendulums p;
  const auto s = scene_of(p.chain);
  REQUIRE(s.frames.size() == 5);
  REQUIRE(s.pulls.size() == 2);
  CHECK(s.frames[static_cast<std::size_t>(s.pulls[0])].name == "joint");
  CHECK(s.frames[static_cast<std::size_t>(s.pulls[1])].name == "arm");
  CHECK(s.forces.empty());
  CHECK(s.notes.empty());
  CHECK(s.model.find("pull") == s.model.npos);
  CHECK_THAT(to_json(s), contains_text(R"("pulls":[1,3])"));
}

TEST_CASE("a pull is a spring and a damper on a point of its frame") {
  pulled_pendulums p;
  auto s = p.chain.make_state();
  const std::vector<double> q{0.4, -0.3}, v{0.7, 0.2}, none{0, 0};
  const Eigen::VectorXd free = forward_dynamics(p.chain, s, q, v, none);
  p.hand = {"arm", {0.5, 0.1, 7}, {0.3, 0.9, -2}, 50, 4};
  const Eigen::VectorXd a = forward_dynamics(p.chain, s, q, v, none);
  // of the point, by angles
  const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c2 = std::cos(q[0] + q[1]), s2 = std::sin(q[0] + q[1]);
  const double w = v[0] + v[1], rx = 0.5 * c2 - 0.1 * s2, ry = 0.5 * s2 + 0.1 * c2;
  const double fx = 50 * (0.3 - 0.5 * c1 - rx) - 4 * (-0.5 * s1 * v[0] - ry * w);
  const double fy = 50 * (0.9 - 0.5 * s1 - ry) - 4 * (0.5 * c1 * v[0] + rx * w);
  const Eigen::Vector2d forces{(0.5 * c1 + rx) * fy - (0.5 * s1 + ry) * fx, rx * fy - ry * fx};
  const Eigen::MatrixXd mass = mass_matrix(p.chain, s, q);
  const Eigen::VectorXd got = mass * (a - free);
  for (int i = 0; i < 2; ++i) CHECK(got[i] == within(forces[i], 1e-11));
  p.hand.frame.clear();
  CHECK((forward_dynamics(p.chain, s, q, v, none) - free).norm() == 0);
}

TEST_CASE("a static chain is pulled where it has an element for that") {
  static page_pull hand{"tip", {}, {0.5, 1, 0}, 20, 0};
  using namespace models;
  constexpr auto chain = kte::chain(revolute_joint_2D(q, base, joint), rigid_link_2D(joint, tip, along_x(0.5)),
                                    inertia_2D(tip, point_mass(1.0)), pull_2D(tip, hand));
  const std::array<double, 1> at{0};
  CHECK(forward_dynamics(chain, at, at, at)[0] == within(20 * 1 * 0.5 / 0.25, 1e-13));
  hand.frame = "joint";
  CHECK(forward_dynamics(chain, at, at, at)[0] == 0);
}

TEST_CASE("pages pull frames, and let them go") {
  const pulled_pendulums p;
  live_page page(p.chain);
  const http_address at(page.url());
  open_page client(at);
  CHECK(page.pull().frame.empty());
  REQUIRE(status_of(at.post(request("3", "0.25", "-1e-1"))) == "204");
  const auto pull = page.pull();
  CHECK(pull.frame == "arm");
  CHECK((pull.point.x == 0.25 && pull.point.y == 0 && pull.target.x == 0.5 && pull.target.y == -0.1));
  CHECK(pull.stiffness == 4 * 9 * 9);
  CHECK(pull.damping == within(2 * 0.4 * 4 * 9, 1e-12));
  auto s = p.chain.make_state();
  p.chain.doMotion(s), page.show(1, s);
  CHECK_THAT(client.event("state"),
             contains_text(R"("pull":{"frame":"arm","point":[0.25,0,0],"target":[0.5,-0.1,0],)"));
  CHECK(status_of(at.post("release")) == "204");
  CHECK(page.pull().frame.empty());
  REQUIRE(status_of(at.post(request("1", "0", "0"))) == "204");
  CHECK(page.pull().frame == "joint");
  CHECK(comes_true([&] { return page.pull().frame.empty(); }));  // by itself, where the page says nothing more
}

TEST_CASE("pulls out of limits are refused") {
  const pulled_pendulums p;
  live_page page(p.chain);
  const http_address at(page.url());
  for (const auto& bad :
       {request("0", "0", "0"), request("2", "0", "0"), request("5", "0", "0"), request("-1", "0", "0"),
        request("1", "nan", "0"), request("1", "0", "inf"), request("1", "0", "1e4"), request("1", "-2000", "0"),
        request("1", "", "0"), request("1", "0x1", "0"), std::string("pull"), std::string("pull?frame=1&x=0"),
        request("1", "0", "0") + "&x=1"}) {
    INFO(bad);
    CHECK(status_of(at.post(bad)) == "400");
    CHECK(status_of(at.get(bad)) == "404");
  }
  auto other = at;
  other.host = "evil.example";
  CHECK(status_of(other.post(request("1", "0", "0"))) == "403");
  CHECK(status_of(at.ask(at.text("POST", request("1", "0", "0"), "Origin: http://evil.example\r\n"))) == "403");
  CHECK(page.pull().frame.empty());
  live_page without(pendulum);  // no element takes a pull
  CHECK(status_of(http_address(without.url()).post(request("1", "0", "0"))) == "400");
}

}  // namespace live_pull_test
