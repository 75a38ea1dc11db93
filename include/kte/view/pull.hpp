#pragma once

#include <kte/contract/no_parameters.hpp>
#include <kte/contract/transmission.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/view/page_pull.hpp>

#include <string_view>

/// Elements by which the pointer in a page pulls bodies of a running simulation (docs/live.md).
namespace kte {

namespace core {

/// The force of a pull on the point r of a frame with the pose p, R, while a page pulls this frame:
///
///   F = k (R^T (t - p) - r) - c (v + w x r),  T = r x F          (1)
///
/// In the plane, out-of-plane components of r and t are ignored. The program owns the `page_pull` and may change it at
/// any time.
template <kind Dim, class Name>
struct pull : no_parameters {
  static constexpr type_name type{"pull", Dim};
  static constexpr std::array<port, 1> ports{{{Dim, access::on, "frame"}}};
  static constexpr bool reads_positions = true;

  const page_pull* by;
  Name frame;

  template <class Frame>
  constexpr auto doForce(const Frame& x) const {
    const bool here = by->frame == frame;
    const double k = here ? by->stiffness : 0, c = here ? by->damping : 0;
    const auto r = flat(by->point), t = flat(by->target);
    const auto stretch = transpose(x.rotation) * (t - x.position) - r;
    const auto force = k * stretch - c * (x.velocity + cross(x.ang_velocity, r));
    return make_loads(wrench{force, cross(r, force)});  // (1)
  }

 private:
  static constexpr auto flat(const vec3<>& p) {
    if constexpr (Dim == kind::frame_2D) {
      return vec3{p.x, p.y, zero};
    } else {
      return p;
    }
  }
};

}  // namespace core

/// An element that pulls `frame`, a key or a text, in the plane while `by` names this frame. `by` must outlive the
/// chain.
template <class F>
[[nodiscard]] constexpr auto pull_2D(const F& frame, const page_pull& by) {
  if constexpr (key_type<F>) {
    return connect(core::pull<kind::frame_2D, std::string_view>{{}, &by, F::name}, frame);
  } else {
    return connect(core::pull<kind::frame_2D, std::string>{{}, &by, std::string(frame)}, frame);
  }
}
/// An element that pulls `frame`, a key or a text, in space; see `pull_2D`.
template <class F>
[[nodiscard]] constexpr auto pull_3D(const F& frame, const page_pull& by) {
  if constexpr (key_type<F>) {
    return connect(core::pull<kind::frame_3D, std::string_view>{{}, &by, F::name}, frame);
  } else {
    return connect(core::pull<kind::frame_3D, std::string>{{}, &by, std::string(frame)}, frame);
  }
}

/// The chain with a pull element on each frame that a joint moves.
[[nodiscard]] inline runtime_chain with_pulls(runtime_chain c, const page_pull& by) {
  for (const kind k : {kind::frame_2D, kind::frame_3D}) {
    const auto at = static_cast<std::size_t>(k);
    const auto names = c.wiring().names[at];
    const auto writers = c.wiring().writers[at];
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (writers[i] < 0) continue;
      const auto& e = c.wiring().elements[static_cast<std::size_t>(writers[i])];
      if (!e.rigid || !is_coordinate(e.ports.front().what)) continue;
      if (k == kind::frame_2D)
        c << pull_2D(names[i], by);
      else
        c << pull_3D(names[i], by);
    }
  }
  return c;
}

}  // namespace kte
