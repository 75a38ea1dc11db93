#include <kte/robots/load_robot.hpp>
#include <kte/robots/urdf_writer.hpp>

#include <urdf_parser/urdf_parser.h>

#include "catch.hpp"
#include "robots/files.hpp"

namespace urdfdom_test {

using namespace kte;
using test::robot_file;

/// urdfdom has quaternions.
void same(const urdf::Pose& there, const robot_pose& here) {
  CHECK((there.position.x == here.position.x && there.position.y == here.position.y));
  CHECK(there.position.z == here.position.z);
  const auto q = to_quaternion(here.rotation);
  const auto& r = there.rotation;
  const double sign = q.w * r.w + q.x * r.x + q.y * r.y + q.z * r.z < 0 ? -1 : 1;
  CHECK((q.w == within(sign * r.w, 1e-15) && q.x == within(sign * r.x, 1e-15)));
  CHECK((q.y == within(sign * r.y, 1e-15) && q.z == within(sign * r.z, 1e-15)));
}

TEST_CASE("urdfdom reads robots written as URDF as the same numbers") {
  const auto name = GENERATE("iiwa14.urdf", "everything.urdf", "parts.urdf");
  CAPTURE(name);
  const auto d = describe(load_robot(robot_file(name), {.quarter_turn_tolerance = 1e-6}));
  const auto file = urdf::parseURDF(to_urdf(d));
  REQUIRE(file);
  CHECK(file->getName() == d.name);
  REQUIRE(file->links_.size() == d.links.size());
  REQUIRE(file->joints_.size() == d.joints.size());
  for (const auto& l : d.links) {
    const auto& there = *file->getLink(l.name);
    REQUIRE(bool(there.inertial) == l.inertial.has_value());
    if (!l.inertial) continue;
    const auto& i = l.inertial->inertia;
    const auto& x = *there.inertial;
    CHECK((x.mass == l.inertial->mass && x.ixx == i.xx && x.ixy == i.xy && x.ixz == i.xz && x.iyy == i.yy));
    CHECK((x.iyz == i.yz && x.izz == i.zz));
    same(x.origin, {l.inertial->com, robot_pose{}.rotation});
  }
  for (const auto& j : d.joints) {
    const auto& there = *file->getJoint(j.name);
    using kind = robot_joint::kind;
    const int types[]{urdf::Joint::FIXED,  urdf::Joint::REVOLUTE, urdf::Joint::PRISMATIC, 0,
                      urdf::Joint::PLANAR, urdf::Joint::FLOATING};
    CHECK(there.type == (j.continuous ? int{urdf::Joint::CONTINUOUS} : types[static_cast<int>(j.is)]));
    CHECK((there.parent_link_name == j.parent && there.child_link_name == j.child));
    same(there.parent_to_joint_origin_transform, j.origin);
    if (j.is != kind::revolute && j.is != kind::prismatic) continue;
    CHECK((there.axis.x == j.axis.x && there.axis.y == j.axis.y && there.axis.z == j.axis.z));
    if (there.limits) {
      const auto most = [](double x) { return std::isinf(x) ? std::copysign(1e308, x) : x; };
      CHECK((there.limits->effort == most(j.effort) && there.limits->velocity == most(j.rate)));
      if (!j.continuous) CHECK((there.limits->lower == most(j.lower) && there.limits->upper == most(j.upper)));
    }
    if (j.mimic) CHECK((there.mimic && there.mimic->joint_name == j.mimic->joint));
    if (there.dynamics)
      CHECK((there.dynamics->damping == j.dynamics.damping && there.dynamics->friction == j.dynamics.friction));
  }
}

}  // namespace urdfdom_test
