// expect: error: .*kte: this element.s force depends on a position, rotation or linear velocity
// expect: reads_positions = true
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

namespace core {
struct drag {
  static constexpr kte::type_name type{"drag", kte::kind::frame_3D};
  static constexpr std::array<kte::port, 1> ports{{{kte::kind::frame_3D, kte::access::on, "frame"}}};
  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    return kte::make_loads(kte::wrench{-x.velocity, kte::zero3{}});
  }
  constexpr void check(const kte::parameter_check&) const {}
};
}  // namespace core
constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::connect(core::drag{}, elbow));
auto f(const double* q, const double* v, const double* a) { return kte::inverse_dynamics(arm, q, v, a); }
