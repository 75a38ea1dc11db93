// expect: error: .*kte: the motion of a joint or link follows from its `relative`: it must not have its own `doMotion`
// expect: slack_link
#include <kte/contract/transmission.hpp>
#include <kte/static_chain/static_chain.hpp>

namespace core {
struct slack_link : kte::transmission<slack_link> {
  static constexpr kte::type_name type{"slack_link", kte::kind::frame_3D};
  static constexpr std::array<kte::port, 2> ports{
      {{kte::kind::frame_3D, kte::access::in, "base"}, {kte::kind::frame_3D, kte::access::out, "end"}}};
  constexpr auto relative() const { return kte::at_rest(kte::no_rotation{}, kte::along_x(0.5)); }
  template <class Base>
  constexpr auto doMotion(const Base& base) const {
    return kte::compose(base, kte::at_rest(kte::no_rotation{}, kte::along_x(0.6)));
  }
  constexpr void check(const kte::parameter_check&) const {}
};
}  // namespace core
const auto bar = kte::connect(core::slack_link{}, "base", "end");
