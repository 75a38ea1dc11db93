#pragma once

#include <kte/view/svg/mechanism/drawn_shape.hpp>

/// Styles of the parts of mechanisms, with the palette of Okabe and Ito.
namespace kte::detail::svg::styles {

inline constexpr shape_style link{"#2b3a4a", 0.9}, placement{"#2b3a4a", 0.5}, rail{"#2b3a4a", 0.4, nullptr, "1.2 0.9"},
    joint{"#2b3a4a", 0.4, "#fff"}, joint_line{"#2b3a4a", 0.4}, full{nullptr, 0, "#2b3a4a"},
    body{"#b8770a", 0.2, "#e69f00", nullptr, 0.45}, point_mass{nullptr, 0, "#e69f00"}, spring{"#d55e00", 0.4},
    damper{"#009e73", 0.4}, damper_area{"#009e73", 0.4, "#fff"}, beam{"#0072b2", 0.8},
    loop{"#cc79a7", 0.4, nullptr, "1.2 0.9"}, ground{"#000", 0.3}, hatch{"#000", 0.2}, trail{"#0072b2", 0.25};

}  // namespace kte::detail::svg::styles
