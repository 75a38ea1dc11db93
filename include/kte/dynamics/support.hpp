#pragma once

#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/runtime/frames.hpp>
#include <kte/dynamics/unrolled/plan.hpp>
#include <kte/runtime_chain.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

/// Which coordinates move a frame, and the common ancestor of two frames, for static and runtime chains. Uses the
/// wiring only.
namespace kte {

namespace detail {
using thing_of_chain = std::pair<kind, int>;
/// A frame and its ancestors, up to its base. The parent of a frame is the last port but one of the element that writes
/// it.
template <class Connections>
std::vector<thing_of_chain> stands_on(const Connections& c, thing_of_chain frame) {
  std::vector<thing_of_chain> all{frame};
  for (int e = c.writer(frame.first, frame.second); e >= 0; e = c.writer(frame.first, frame.second)) {
    const auto by = static_cast<std::size_t>(e);
    if (c.ports(by).size() < 2) break;
    const std::size_t base = c.ports(by).size() - 2;
    if (!is_frame(c.ports(by)[base].what)) break;  // its motion is given by signals
    frame = {c.ports(by)[base].what, c.index(by, base)};
    all.push_back(frame);
  }
  return all;
}
/// The first frame of a's ancestry that is also in b's, or {gen, -1} if there is none.
template <class Connections>
thing_of_chain find_common_ancestor(const Connections& c, thing_of_chain a, thing_of_chain b) {
  const auto of_b = stands_on(c, b);
  for (const auto& x : stands_on(c, a))
    if (std::find(of_b.begin(), of_b.end(), x) != of_b.end()) return x;
  return {kind::gen, -1};
}
/// Marks the rates that move a frame: those of the coordinates that are read between base and frame, and those of the
/// coordinates that these and signals follow.
template <class Connections, class Mask>
void mark_support(const Connections& c, thing_of_chain frame, Mask& moves) {
  std::vector<thing_of_chain> ahead{frame};
  while (!ahead.empty()) {
    const auto [k, i] = ahead.back();
    ahead.pop_back();
    const int e = c.writer(k, i);
    if (e >= 0) {
      const auto by = static_cast<std::size_t>(e);
      for (std::size_t p = 0; p + 1 < c.ports(by).size(); ++p) ahead.emplace_back(c.ports(by)[p].what, c.index(by, p));
    } else {
      for (std::size_t f = 0; f < c.freedoms(); ++f) {
        const freedom at = c.freedom_at(f);
        if (at.what != k || at.slot != i) continue;
        for (int n = 0; n < nv_of(k); ++n) moves[static_cast<std::size_t>(at.v + n)] = true;
      }
    }
  }
}
/// The text of thing i of kind k.
template <class Wiring, class... E>
std::string_view name_of_thing(kind k, int i) {
  const auto names = names_at_ports<Wiring, E...>();
  for (std::size_t p = Wiring::ports; p-- > 0;)
    if (Wiring::table.what[p] == k && Wiring::table.slot[p] == i) return names[p];
  return {};
}
}  // namespace detail

/// The degrees of freedom that move a frame: for each number of v, whether its column of `jacobian` may differ from
/// zero.
template <class Gravity, class... E, key_type Frame>
[[nodiscard]] auto support(const static_chain<Gravity, E...>&, const Frame&) {
  using chain_type = static_chain<Gravity, E...>;
  std::array<bool, std::size_t{chain_type::dofs}> moves{};
  detail::mark_support(detail::static_connections<chain_type>{}, {Frame::what, detail::frame_slot<Frame, chain_type>()},
                       moves);
  return moves;
}
/// The degrees of freedom that move a frame of a runtime chain; see above. Throws `unknown_name`.
[[nodiscard]] inline std::vector<bool> support(const runtime_chain& c, const name_or_handle& frame) {
  const auto x = detail::find_frame(c, frame);
  std::vector<bool> moves(static_cast<std::size_t>(c.dofs()));
  detail::mark_support(detail::runtime_connections{c.wiring()}, {x.what, x.index}, moves);
  return moves;
}

/// The name of the last common ancestor of two frames by links and joints, which may be one of them; empty if they have
/// different bases.
template <class Gravity, class... E, key_type A, key_type B>
[[nodiscard]] std::string_view common_ancestor(const static_chain<Gravity, E...>&, const A&, const B&) {
  using chain_type = static_chain<Gravity, E...>;
  const auto [k, i] = detail::find_common_ancestor(detail::static_connections<chain_type>{},
                                                   {A::what, detail::frame_slot<A, chain_type>()},
                                                   {B::what, detail::frame_slot<B, chain_type>()});
  return i < 0 ? std::string_view() : detail::name_of_thing<typename chain_type::wiring, E...>(k, i);
}
/// The name of the last common ancestor of two frames of a runtime chain; see above. Throws `unknown_name`.
[[nodiscard]] inline std::string common_ancestor(const runtime_chain& c, const name_or_handle& a,
                                                 const name_or_handle& b) {
  const auto x = detail::find_frame(c, a), y = detail::find_frame(c, b);
  const auto [k, i] =
      detail::find_common_ancestor(detail::runtime_connections{c.wiring()}, {x.what, x.index}, {y.what, y.index});
  return i < 0 ? std::string() : c.wiring().names[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
}

}  // namespace kte
