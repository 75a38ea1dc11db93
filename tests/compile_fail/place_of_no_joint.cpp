// mistakes: 5
// expect: error: .*kte: .at.position.* places the seat of a joint in its base; this element is no joint
// expect: spring
// expect: rigid_link
// expect: error: .*kte: this joint has a place in its base already: .at.. comes once
// expect: error: .*kte: call it as .at.position.*, such as .at.kte::along_z.0.5., kte::quarter_turn_x
// expect: error: .*kte: call it as .at.position.*, such as .at.kte::along_x.0.5., kte::rotation_by.0.3
#include <kte/kte.hpp>

using namespace kte;
inline constexpr struct q_ final : coord_key<"q"> {
} q;
inline constexpr struct base_ final : frame_3D_key<"base"> {
} base;
inline constexpr struct arm_ final : frame_3D_key<"arm"> {
} arm;
void f() {
  spring_3D("wall", "arm", 0.2, 300.0).at(along_x(0.5));
  rigid_link_3D("wall", "arm", along_x(0.5)).at(along_x(0.5));
  chain(revolute_joint_3D(q, base, arm).at(along_x(0.5)).at(along_x(0.5)));
  chain(revolute_joint_3D(q, base, arm).at(along_x(0.5), rotation_by(0.3)));
  kte_map_chain() << prismatic_joint_2D("q", "base", "arm", axis::x).at(along_x(0.5), quarter_turn_x);
}
