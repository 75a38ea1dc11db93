#pragma once

#include <kte/dynamics/jacobian.hpp>
#include <kte/manipulators/detail/arm_geometry.hpp>

namespace kte::detail {

/// Whether element I is a free body, whose coordinate is its pose.
template <std::size_t I, class Chain>
constexpr bool floats() {
  using core_t = typename Chain::template core_type<I>;
  using wiring = typename Chain::wiring;
  if constexpr (!is_transmission<core_t> || coordinates_of<core_t> == 0) {
    return false;
  } else {
    constexpr kind what = core_t::ports[0].what;
    if constexpr (what == kind::pose_2D || what == kind::pose_3D)
      return wiring::template is_free<what, wiring::slot(I, 0)>;
    else
      return false;
  }
}
/// Why an element cannot be between the base and the tool, if its type alone decides this; otherwise null.
template <std::size_t I, class Chain>
constexpr const char* refused_by_type() {
  using core_t = typename Chain::template core_type<I>;
  using wiring = typename Chain::wiring;
  if constexpr (!is_transmission<core_t>) {
    return "has an element that is neither joint nor link between base and tool";
  } else if constexpr (coordinates_of<core_t> == 0 || floats<I, Chain>()) {
    return nullptr;
  } else if constexpr (varying_axes<core_t>) {
    return "has a joint with axes that depend on its coordinates";
  } else if constexpr (core_t::ports[0].what != kind::gen) {
    return "has a joint of several degrees of freedom";
  } else {
    constexpr bool is_free = wiring::template is_free<kind::gen, wiring::slot(I, 0)>;
    return is_free ? nullptr : "has a joint whose coordinate is given, or follows others";
  }
}

/// Adds element I at coordinate zero. Avoids sines, so that it can be evaluated at compile time.
template <std::size_t I, class Chain>
constexpr void add_element(const Chain& c, pose<mat3<vec3<>>, vec3<>>& x, arm_geometry& arm) {
  using core_t = typename Chain::template core_type<I>;
  using wiring = typename Chain::wiring;
  const auto step = [&](const auto& m) {
    x = {as<double>(x.rotation * as<double>(matrix(m.rotation))),
         as<double>(x.rotation * as<double>(m.position) + x.position)};
  };
  if constexpr (refused_by_type<I, Chain>() != nullptr) {
    arm.refused = refused_by_type<I, Chain>();
  } else if constexpr (coordinates_of<core_t> == 0) {
    step(c.template core<I>().relative());
  } else if constexpr (floats<I, Chain>()) {
    constexpr kind what = core_t::ports[0].what;
    if (arm.moves != arm_geometry::freely::not_at_all) arm.refused = "has a joint of several degrees of freedom";
    step(c.template core<I>().relative(motion{zero3{}, no_rotation{}, zero3{}, zero3{}, zero3{}, zero3{}}));
    arm.placement = x, x = arm_geometry{}.placement;
    arm.moves = what == kind::pose_2D ? arm_geometry::freely::in_plane : arm_geometry::freely::in_space;
    arm.in_q[0] = wiring::template at<what, wiring::slot(I, 0)>.q;
    arm.in_v[0] = wiring::template at<what, wiring::slot(I, 0)>.v;
  } else {
    const auto m = c.template core<I>().relative(coordinate{0.0, 1.0, 0.0, 1.0, 0.0});
    step(m);
    const vec3<> v = as<double>(m.velocity), w = as<double>(m.ang_velocity);
    const bool slides = dot(w, w) == 0;
    if (!slides && dot(v, v) != 0) arm.refused = "has a screw joint";
    arm.add(x.rotation * (slides ? v : w), x.position, slides, wiring::template at<kind::gen, wiring::slot(I, 0)>.q,
            wiring::template at<kind::gen, wiring::slot(I, 0)>.v);
  }
}

/// Whether the elements between the base and a frame may have a closed form: three, four, six or seven joints with one
/// degree of freedom, and links.
template <class Frame, class Chain>
constexpr bool may_have_closed_form() {
  using path = branch<Chain, Frame::what, frame_slot<Frame, Chain>()>;
  int joints = 0, floating = 0;
  bool refused = false;
  const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((joints += coordinates_of<typename Chain::template core_type<path::elements[I]>> > 0,
      floating += floats<path::elements[I], Chain>(),
      refused |= refused_by_type<path::elements[I], Chain>() != nullptr),
     ...);
  };
  each(std::make_index_sequence<path::length>{});
  if (floating > 0) return !refused && joints == 1;
  return !refused && (joints == 3 || joints == 4 || joints == 6 || joints == 7);
}

/// The geometry of the joints between the base and a frame.
template <class Frame, class Chain>
constexpr arm_geometry geometry_of(const Chain& c) {
  using path = branch<Chain, Frame::what, frame_slot<Frame, Chain>()>;
  arm_geometry arm;
  auto x = arm.tool;
  const auto each = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (add_element<path::elements[I]>(c, x, arm), ...);
  };
  each(std::make_index_sequence<path::length>{});
  arm.tool = x;
  if (arm.moves != arm_geometry::freely::not_at_all && arm.n > 0)
    arm.refused = "has a joint of several degrees of freedom";
  for (int i = 0; i < arm.n; ++i)
    for (int j = 0; j < i; ++j)
      if (arm.in_q[std::size_t(i)] == arm.in_q[std::size_t(j)]) arm.refused = "has joints that share a coordinate";
  return arm;
}

}  // namespace kte::detail
