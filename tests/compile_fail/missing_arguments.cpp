// mistakes: 36
// The factories of all elements, each without its last argument.
// expect: error: .*kte: call it as base_gen.coordinate
// expect: error: .*kte: call it as base_2D.frame
// expect: error: .*kte: call it as base_3D.frame
// expect: error: .*kte: call it as cylindrical_joint_3D.turn, slide, base, end, axis
// expect: error: .*kte: call it as damper_gen.anchor1, anchor2, damping
// expect: error: .*kte: call it as damper_2D.anchor1, anchor2, damping
// expect: error: .*kte: call it as damper_3D.anchor1, anchor2, damping
// expect: error: .*kte: call it as driving_actuator_gen.coordinate, input
// expect: error: .*kte: call it as fixed_joint_2D.base, end
// expect: error: .*kte: call it as fixed_joint_3D.base, end
// expect: error: .*kte: call it as free_joint_2D.coordinate, base, end
// expect: error: .*kte: call it as free_joint_3D.coordinate, base, end
// expect: error: .*kte: call it as hooke_joint_3D.q1, q2, base, end, axis1, axis2, offset
// expect: error: .*kte: call it as inertia_gen.coordinate, mass
// expect: error: .*kte: call it as inertia_2D.frame, body
// expect: error: .*kte: call it as inertia_3D.frame, body
// expect: error: .*kte: call it as joint_backlash_gen.anchor1, anchor2, gap, stiffness, damping
// expect: error: .*kte: call it as joint_lugre_gen.coordinate, bristles, parameters
// expect: error: .*kte: call it as planar_joint_3D.coordinate, base, end
// expect: error: .*kte: call it as prismatic_joint_2D.coordinate, base, end, axis
// expect: error: .*kte: call it as prismatic_joint_3D.coordinate, base, end, axis
// expect: error: .*kte: call it as revolute_joint_2D.coordinate, base, end
// expect: error: .*kte: call it as revolute_joint_3D.coordinate, base, end
// expect: error: .*kte: call it as rigid_link_gen.base, end, offset
// expect: error: .*kte: call it as rigid_link_2D.base, end, position
// expect: error: .*kte: call it as rigid_link_3D.base, end, position
// expect: error: .*kte: call it as screw_joint_3D.coordinate, base, end, axis, pitch
// expect: error: .*kte: call it as spherical_joint_3D.coordinate, base, end
// expect: error: .*kte: call it as spring_gen.anchor1, anchor2, rest_length, stiffness
// expect: error: .*kte: call it as spring_2D.anchor1, anchor2, rest_length, stiffness
// expect: error: .*kte: call it as spring_3D.anchor1, anchor2, rest_length, stiffness
// expect: error: .*kte: call it as torsion_damper_2D.anchor1, anchor2, damping
// expect: error: .*kte: call it as torsion_damper_3D.anchor1, anchor2, damping
// expect: error: .*kte: call it as torsion_spring_2D.anchor1, anchor2, stiffness
// expect: error: .*kte: call it as torsion_spring_3D.anchor1, anchor2, stiffness
// expect: error: .*kte: call it as universal_joint_3D.q1, q2, base, end, axis1, axis2
#include <kte/elements/base.hpp>
#include <kte/elements/cylindrical_joint.hpp>
#include <kte/elements/damper.hpp>
#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/fixed_joint.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/joint_backlash.hpp>
#include <kte/elements/joint_lugre.hpp>
#include <kte/elements/planar_joint.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/elements/torsion_damper.hpp>
#include <kte/elements/torsion_spring.hpp>
#include <kte/elements/universal_joint.hpp>

using namespace kte;
void f() {
  base_gen();
  base_2D();
  base_3D();
  cylindrical_joint_3D("turn", "slide", "base", "end");
  damper_gen("anchor1", "anchor2");
  damper_2D("anchor1", "anchor2");
  damper_3D("anchor1", "anchor2");
  driving_actuator_gen("coordinate");
  fixed_joint_2D("base");
  fixed_joint_3D("base");
  free_joint_2D("coordinate", "base");
  free_joint_3D("coordinate", "base");
  hooke_joint_3D("q1", "q2", "base", "end", axis::x, axis::y);
  inertia_gen("coordinate");
  inertia_2D("frame");
  inertia_3D("frame");
  joint_backlash_gen("anchor1", "anchor2", 1.0, 1.0);
  joint_lugre_gen("coordinate", "bristles");
  planar_joint_3D("coordinate", "base");
  prismatic_joint_2D("coordinate", "base", "end");
  prismatic_joint_3D("coordinate", "base", "end");
  revolute_joint_2D("coordinate", "base");
  revolute_joint_3D("coordinate", "base");
  rigid_link_gen("base", "end");
  rigid_link_2D("base", "end");
  rigid_link_3D("base", "end");
  screw_joint_3D("coordinate", "base", "end", axis::x);
  spherical_joint_3D("coordinate", "base");
  spring_gen("anchor1", "anchor2", 1.0);
  spring_2D("anchor1", "anchor2", 1.0);
  spring_3D("anchor1", "anchor2", 1.0);
  torsion_damper_2D("anchor1", "anchor2");
  torsion_damper_3D("anchor1", "anchor2");
  torsion_spring_2D("anchor1", "anchor2");
  torsion_spring_3D("anchor1", "anchor2");
  universal_joint_3D("q1", "q2", "base", "end", axis::x);
}
