// expect: error: .*kte: this element.s force depends on a position, rotation or linear velocity
// expect: reads_positions = true
#include <kte/chain/checks.hpp>
#include <kte/chain/kte_map_chain.hpp>

namespace core {
struct buoyancy {
  static constexpr kte::type_name type{"buoyancy", kte::kind::frame_3D};
  static constexpr std::array<kte::port, 1> ports{{{kte::kind::frame_3D, kte::access::on, "frame"}}};
  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    const auto up = kte::transpose(kte::matrix(x.rotation)) * kte::along_z(1.0);
    return kte::make_loads(kte::wrench{-x.position.z * up, kte::zero3{}});
  }
  constexpr void check(const kte::parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};
}  // namespace core
void f(kte::kte_map_chain& arm) { arm << kte::connect(core::buoyancy{}, "elbow"); }
