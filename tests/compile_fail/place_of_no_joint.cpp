// mistakes: 7
// expect: error: .*kte: .at.position.* places a joint in its base; this element is not a joint
// expect: spring
// expect: rigid_link
// expect: error: .*kte: this joint has a placement already: call .at.. once
// expect: error: .*kte: call it as .at.position.*, such as .at.kte::along_z.0.5., kte::quarter_turn_x
// expect: error: .*kte: call it as .at.position.*, such as .at.kte::along_x.0.5., kte::rotation_by.0.3
// expect: error: .*kte: a joint with its own `doForce` cannot be placed
#include <kte/kte.hpp>

using namespace kte;
inline constexpr struct q_ final : coord_key<"q"> {
} q;
inline constexpr struct base_ final : frame_3D_key<"base"> {
} base;
inline constexpr struct arm_ final : frame_3D_key<"arm"> {
} arm;
struct sticky : transmission<sticky> {
  static constexpr type_name type{"sticky", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::in, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  template <class C>
  constexpr auto relative(const C& c) const {
    return motion{axis::x * c.q, no_rotation{}, axis::x * c.q_dot, zero3{}, axis::x * c.q_ddot, zero3{}};
  }
  template <class C, class Base, class Wrench>
  constexpr auto doForce(const C& c, const Base& base, const Wrench& end) const;
  constexpr void check(const parameter_check&) const {}
};
void f() {
  connect(sticky{}, "q", "base", "arm").at(along_x(0.5));
  spring_3D("wall", "arm", 0.2, 300.0).at(along_x(0.5));
  rigid_link_3D("wall", "arm", along_x(0.5)).at(along_x(0.5));
  (void)chain(revolute_joint_3D(q, base, arm).at(along_x(0.5)).at(along_x(0.5)));
  (void)chain(revolute_joint_3D(q, base, arm).at(along_x(0.5), rotation_by(0.3)));
  runtime_chain() << prismatic_joint_2D("q", "base", "arm", axis::x).at(along_x(0.5), quarter_turn_x);
  runtime_chain() << universal_joint_3D("q", "p", "base", "arm", axis::x, axis::y).at(along_x(0.5), rotation_by(0.3));
}
