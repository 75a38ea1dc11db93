// mistakes: 6
// expect: error: .*kte: an element core has static members `type`, its name, and `ports`
// expect: error: .*kte: an element that writes no signal has a function doForce
// expect: error: .*kte: an element that writes a coordinate, a frame or a signal has a function doMotion
// expect: error: .*kte: a joint or link has a function relative
// expect: error: .*kte: an element with an internal state has a function z_dot
// expect: error: .*kte: the port that an element writes is the last of its ports
#include <kte/contract/transmission.hpp>

using namespace kte;

struct rules_for_nothing {
  constexpr void check(const parameter_check&) const {}
};

struct nameless : rules_for_nothing {};
struct forceless : rules_for_nothing {
  static constexpr type_name type{"forceless", kind::gen};
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};
};
struct sensor : rules_for_nothing {
  static constexpr type_name type{"sensor", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::input, access::out, "out"}}};
};
struct link : rules_for_nothing, transmission<link> {
  static constexpr type_name type{"link", kind::frame_3D};
  static constexpr std::array<port, 2> ports{
      {{kind::frame_3D, access::in, "base"}, {kind::frame_3D, access::out, "end"}}};
};
struct bristles : rules_for_nothing {
  static constexpr type_name type{"bristles", kind::gen};
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::on, "coordinate"}, {kind::internal, access::keep, "z"}}};
  template <class C, class Z>
  constexpr auto doForce(const C&, const Z& z) const {
    return make_loads(-z);
  }
};
struct backwards : rules_for_nothing {
  static constexpr type_name type{"backwards", kind::gen};
  static constexpr std::array<port, 2> ports{{{kind::gen, access::out, "end"}, {kind::gen, access::in, "base"}}};
  template <class C>
  constexpr auto doForce(const C&) const {
    return make_loads(zero);
  }
};

const auto a = connect(nameless{}, "q");
const auto b = connect(forceless{}, "q");
const auto c = connect(sensor{}, "q", "u");
const auto d = connect(link{}, "a", "b");
const auto e = connect(bristles{}, "q", "z");
const auto f = connect(backwards{}, "q", "p");
