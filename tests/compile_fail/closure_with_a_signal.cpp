// expect: error: .*kte: a closure has ports of two frames, or of one to four coordinates, and of its loop
// expect: rod_of_signal
#include <kte/elements/closures.hpp>
#include <kte/kte.hpp>

struct rod_of_signal : kte::coordinate_closure<rod_of_signal> {
  static constexpr std::string_view type = "rod_of_signal";
  static constexpr std::array<kte::port, 3> ports{{{kte::kind::gen, kte::access::on, "coordinate"},
                                                   {kte::kind::input, kte::access::in, "length"},
                                                   {kte::kind::loop, kte::access::keep, "loop"}}};
  template <class Q, class U>
  constexpr auto value(const Q& q, const U& u) const {
    return q - u;
  }
  constexpr void check(const kte::parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

const auto element = kte::connect(rod_of_signal{}, "q", "u", "l");
