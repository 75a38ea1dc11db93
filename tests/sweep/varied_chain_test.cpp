#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/elements/all.hpp>
#include <kte/sweep/varied_chain.hpp>

#include "catch.hpp"

namespace varied_chain_test {

using kte::test::says;

kte::runtime_chain arm(double length, double mass, double com_z, double damping, double gravity) {
  kte::runtime_chain c;
  c << kte::revolute_joint_3D("q1", "base", "a", kte::axis::y) << kte::joint_damping_gen("q1", damping)
    << kte::rigid_link_3D("a", "b", kte::vec3<>{length, 0.0, 0.1})
    << kte::revolute_joint_3D("q2", "b", "tool", kte::axis::y) << kte::joint_damping_gen("q2", 0.2)
    << kte::inertia_3D("tool",
                       kte::rigid_body{mass, kte::vec3<>{0.1, 0.0, com_z}, kte::sym3<>{0.2, 0, 0, 0.2, 0, 0.2}});
  return std::move(c.gravity(kte::vec3<>{0.0, 0.0, gravity}));
}

TEST_CASE("parameters of a runtime chain by their paths") {
  const auto c = arm(0.4, 1, 0.2, 0.1, -9.81);
  const kte::varied_chain varied(c, {"tool/mass", "b/position/x", "gravity/z", "tool/com/z", "q1/damping"});
  CHECK(varied.size() == 5);
  CHECK(record_of(varied.with(std::array{1.0, 0.4, -9.81, 0.2, 0.1})) == record_of(c));
  const auto other = varied.with(std::array{3.0, 0.5, -1.62, 0.3, 0.7});
  CHECK(record_of(other) == record_of(arm(0.5, 3, 0.3, 0.7, -1.62)));
  CHECK(record_of(varied.with(std::array{1.0, 0.4, -9.81, 0.2, 0.1})) == record_of(c));  // unchanged by the call before
}

TEST_CASE("paths that a chain does not have, or several times, and bad values") {
  const auto c = arm(0.4, 1, 0.2, 0.1, -9.81);
  for (const char* path : {"tool/weight", "tool/com", "tool/com/w", "tool/mass/x", "gravity", "tol/mass"})
    CHECK_THROWS_MATCHES(kte::varied_chain(c, {path}), kte::unknown_name,
                         says(std::string("the chain has no parameter '") + path + "'; paths are NAME/PARAMETER"));
  auto twice = c;
  twice << kte::inertia_3D("tool", kte::point_mass(2.0));
  CHECK_THROWS_MATCHES(kte::varied_chain(twice, {"tool/mass"}), kte::bad_argument,
                       says("the path 'tool/mass' names parameters of 2 elements"));
  const kte::varied_chain varied(c, {"tool/mass"});
  CHECK_THROWS_MATCHES(varied.with(std::array{-1.0}), kte::bad_parameter, says("inertia_3D (frame 'tool'): mass must"));
  CHECK_THROWS_MATCHES(varied.with(std::array{1.0, 2.0}), kte::bad_argument, says("2 values for 1 parameters"));
}

}  // namespace varied_chain_test
