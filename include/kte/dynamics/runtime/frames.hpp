#pragma once

#include <kte/dynamics/runtime/elements.hpp>

#include <utility>

/// The frames of runtime chains: what moves them, and their motion.
namespace kte {

namespace detail {

struct runtime_frame {
  kind what;
  int index;
};
inline runtime_frame find_frame(const runtime_chain& c, const name_or_handle& frame) {
  const auto [k, index] = frame.frame_of(c.wiring());
  return {k, index};
}
/// doMotion of an element, after that of all elements on which it depends, each once.
template <class S>
void move_element(const topology& t, basic_runtime_state<S>& s, int element) {
  const auto at = [](auto& x, int e) -> auto& { return x[static_cast<std::size_t>(e)]; };
  auto& wanted = s.work.wanted;
  at(wanted, element) = 1;
  int first = element;
  for (int e = element; e >= first; --e) {
    if (!at(wanted, e)) continue;
    const auto& c = at(t.elements, e);
    for (std::size_t p = 0; p < c.ports.size(); ++p) {
      if (c.ports[p].writes()) continue;
      const int writer = at(t.writers[static_cast<std::size_t>(c.ports[p].what)], c.index[p]);
      if (writer >= 0) at(wanted, writer) = 1, first = (std::min)(first, writer);
    }
  }
  for (int e = first; e <= element; ++e)
    if (std::exchange(at(wanted, e), 0)) at(t.elements, e).element->doMotion(s);
}
/// The element that writes a frame, or none.
template <class S>
void move(const topology& t, basic_runtime_state<S>& s, const runtime_frame& x) {
  const int writer = t.writers[static_cast<std::size_t>(x.what)][static_cast<std::size_t>(x.index)];
  if (writer >= 0) move_element(t, s, writer);
}

/// Throws `bad_argument` for a frame that follows others.
template <class S>
void refuse_following(const runtime_chain& c, const basic_runtime_state<S>& s, const runtime_frame& x) {
  if (s.tree().body_tree.frame(x.what, x.index).slot >= 0) [[likely]]
    return;
  throw bad_argument("kte: this algorithm supports only frames that joints and links move, and '" +
                     c.wiring().names[static_cast<std::size_t>(x.what)][static_cast<std::size_t>(x.index)] +
                     "' follows others");
}
/// Calls f(motion) for a frame in its present state.
template <class S, class F>
auto with_motion(basic_runtime_state<S>& s, const runtime_frame& x, const F& f) {
  return x.what == kind::frame_2D ? f(spatial(s.template get<kind::frame_2D>(x.index)))
                                  : f(spatial(s.template get<kind::frame_3D>(x.index)));
}
template <class S>
struct passes_in {
  static_assert(std::is_same_v<S, double>,
                "kte: elements of runtime chains have passes in double only: motion of frames and energies need a "
                "kte::runtime_state");
  static constexpr bool known = true;
};
template <class S>
inline constexpr bool goes_through_passes = passes_in<S>::known;

#ifdef KTE_EXTERN
KTE_EXTERN template void move_element(const topology&, runtime_state&, int);
#endif

}  // namespace detail

}  // namespace kte
