#pragma once

#include <kte/dynamics/frame_motion.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/runtime/bodies.hpp>
#include <kte/runtime_chain.hpp>

#include <string>
#include <vector>

/// Reactions of joints and links, on static and runtime chains.
namespace kte {

/// The reaction of a joint or link: the `frame` that it moves, and the wrench `reaction` at the origin of this frame,
/// in its axes.
struct joint_reaction_entry {
  std::string frame;
  wrench<vec3<>, vec3<>> reaction;
};

namespace detail {
template <class S, class L, class Diagnose = too_large>
wrench<vec3<S>, vec3<S>> reaction_to(const L& load, const Diagnose& why = {"a force"}) {
  const auto x = checked<S>(-load.force, -load.torque, why);
  return {x.linear, x.angular};
}
}  // namespace detail

/// The wrench, N and Nm, that a joint or link exerts on its subtree, at the frame that it moves and in its axes: the
/// load on its bearings and motor, at q, v, a under gravity and the forces of elements. With the axis s of a joint
///
///   s . w = tau of `inverse_dynamics`          (1)
///
/// if no element acts on its coordinate. For a subtree with a single mass m at a_c, w = m (a_c - g) at this mass.
/// Computed by the passes of inverse dynamics, with bases at rest and inputs zero.
template <class Gravity, class... E, indexable Q, indexable V, indexable A, key_type Frame>
[[nodiscard]] auto joint_reaction(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a,
                                  const Frame&) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using wiring = typename chain_type::wiring;
  using S = value_of<Q>;
  constexpr int slot = frame_slot<Frame, chain_type>();
  constexpr int by = wiring::writer(Frame::what, slot);
  static_assert(by >= 0 && static_connections<chain_type>{}.rigid(by < 0 ? 0 : std::size_t(by)),
                "kte: no joint or link moves this frame");
  const auto x = checked_arguments<chain_type>(q, v, a);
  const given g{x.at, x.v, x.a, base_under_gravity(c)};
  using pass = unrolled_passes<chain_type, std::remove_const_t<decltype(g)>>;
  static_assert(sizeof(typename pass::need) > 0);
  return reaction_to<S>(pass(c, g).template load<Frame::what, slot>(), x.diagnosis("a force"));
}

namespace detail {
inline void accumulate_loads(const runtime_chain& c, runtime_state& s) {
  check_whole(c, s), check_state_velocities(s);
  c.doMotion(s), c.clearForce(s), c.doForce(s);
}
inline wrench<vec3<>, vec3<>> reaction_at(const runtime_state& s, kind k, int index) {
  const diagnose_state why{"a force", s};
  if (k == kind::frame_2D) return reaction_to<double>(load_of(s.get<kind::frame_2D>(index)), why);
  return reaction_to<double>(load_of(s.get<kind::frame_3D>(index)), why);
}
/// The frame of this name, if a joint or link moves it. Throws `unknown_name`, `bad_argument`.
inline runtime_frame find_moved_frame(const runtime_chain& c, const name_or_handle& frame) {
  const auto x = find_frame(c, frame);
  const int by = c.wiring().writers[static_cast<std::size_t>(x.what)][static_cast<std::size_t>(x.index)];
  if (by < 0 || !c.wiring().elements[static_cast<std::size_t>(by)].rigid)
    throw bad_argument("kte: no joint or link moves '" +
                       c.wiring().names[static_cast<std::size_t>(x.what)][static_cast<std::size_t>(x.index)] + "'");
  return x;
}
}  // namespace detail

/// The wrench of a joint or link at the positions, rates and accelerations of a state, with its bases and inputs.
/// Throws `unknown_name`, and `bad_argument` if no joint or link moves the frame.
inline wrench<vec3<>, vec3<>> joint_reaction(const runtime_chain& c, runtime_state& s, const name_or_handle& frame) {
  const auto x = detail::find_moved_frame(c, frame);
  detail::accumulate_loads(c, s);
  return detail::reaction_at(s, x.what, x.index);
}
/// The wrench of a joint or link at q, v, a, which are stored in the state.
template <indexable Q, indexable V, indexable A>
wrench<vec3<>, vec3<>> joint_reaction(const runtime_chain& c, runtime_state& s, const Q& q, const V& v, const A& a,
                                      const name_or_handle& frame) {
  (void)detail::find_moved_frame(c, frame), detail::refuse_loops(c), detail::refuse_contacts(c);
  return detail::take(c, s, q, v, a).call([&] { return joint_reaction(c, s, frame); });
}
/// The wrenches of all joints and links, in the order of the chain.
inline std::vector<joint_reaction_entry> joint_reactions(const runtime_chain& c, runtime_state& s) {
  detail::accumulate_loads(c, s);
  std::vector<joint_reaction_entry> all;
  for (const auto& e : c.wiring().elements) {
    if (!e.rigid || e.ports.size() < 3) continue;
    const kind k = e.ports.back().what;
    all.push_back({c.wiring().names[static_cast<std::size_t>(k)][static_cast<std::size_t>(e.index.back())],
                   detail::reaction_at(s, k, e.index.back())});
  }
  return all;
}
template <indexable Q, indexable V, indexable A>
std::vector<joint_reaction_entry> joint_reactions(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                                                  const A& a) {
  detail::refuse_loops(c), detail::refuse_contacts(c);
  return detail::take(c, s, q, v, a).call([&] { return joint_reactions(c, s); });
}

}  // namespace kte
