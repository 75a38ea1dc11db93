// expect: error: .*kte: a joint or link in space turns by a matrix or a quaternion
// expect: sliding_plate
#include <kte/contract/transmission.hpp>
#include <kte/static_chain/static_chain.hpp>

// clang-format off
inline constexpr struct x_     final : kte::pose_2D_key<"x">      {} x;
inline constexpr struct base_  final : kte::frame_3D_key<"base">  {} base;
inline constexpr struct plate_ final : kte::frame_3D_key<"plate"> {} plate;
// clang-format on

namespace core {
struct sliding_plate : kte::transmission<sliding_plate> {
  static constexpr kte::type_name type{"sliding_plate", kte::kind::frame_3D};
  static constexpr std::array<kte::port, 3> ports{{{kte::kind::pose_2D, kte::access::angle, "coordinate"},
                                                   {kte::kind::frame_3D, kte::access::in, "base"},
                                                   {kte::kind::frame_3D, kte::access::out, "end"}}};
  template <class X>
  constexpr auto relative(const X& c) const {
    return kte::motion{c.position,
                       c.rotation,
                       c.velocity,
                       c.ang_velocity,
                       c.acceleration + kte::cross(c.ang_velocity, c.velocity),
                       c.ang_acceleration};
  }
  constexpr void check(const kte::parameter_check&) const {}
};
}  // namespace core
constexpr auto table = kte::chain(kte::connect(core::sliding_plate{}, x, base, plate));
void f() {
  auto s = kte::make_state(table);
  table.doMotion(s), table.doForce(s);
}
