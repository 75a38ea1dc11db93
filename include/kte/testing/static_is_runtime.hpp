#pragma once

#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/elements/base.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/runtime_chain.hpp>
#include <kte/testing/detail/states.hpp>

/// An element behaves equally in static and runtime chains.
namespace kte::testing {

namespace detail {
/// The keys of a trial: the item at port P of the element ('p'), and of its carrier the base ('b') and the pose ('x').
template <kind K, std::size_t P, char Role = 'p'>
struct trial_key {
  static constexpr kind what = K;
  static constexpr std::array<char, 3> text{Role, static_cast<char>('0' + P / 10), static_cast<char>('0' + P % 10)};
  static constexpr std::string_view name{text.data(), text.size()};
};
/// A body on a frame, or a mass on a coordinate.
template <kind K, std::size_t P>
constexpr auto weight_on() {
  constexpr trial_key<K, P> at{};
  if constexpr (K == kind::frame_3D)
    return inertia_3D(at, rigid_body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.3, 0.01, -0.02, 0.25, 0.03, 0.2}});
  else if constexpr (K == kind::frame_2D)
    return inertia_2D(at, planar_body(1.5, 0.3, vec3{0.02, -0.03, zero}));
  else
    return inertia_gen(at, 0.7);
}
/// The carrier of port P of an element: frames are on floating bodies, coordinates have a mass; joints and links are on
/// a base.
template <class Core, std::size_t P>
constexpr auto carrier() {
  constexpr kind k = Core::ports[P].what;
  constexpr bool given = port::declares(Core::ports[P].how);
  if constexpr (!given && k == kind::gen) {
    return chain(weight_on<k, P>());
  } else if constexpr (given || !is_frame(k)) {
    return chain();
  } else if constexpr (kte::detail::is_transmission<Core>) {
    if constexpr (k == kind::frame_3D)
      return chain(base_3D(trial_key<k, P>{}));
    else
      return chain(base_2D(trial_key<k, P>{}));
  } else if constexpr (k == kind::frame_3D) {
    return chain(base_3D(trial_key<k, P, 'b'>{}),
                 free_joint_3D(trial_key<kind::pose_3D, P, 'x'>{}, trial_key<k, P, 'b'>{}, trial_key<k, P>{}),
                 weight_on<k, P>());
  } else {
    return chain(base_2D(trial_key<k, P, 'b'>{}),
                 free_joint_2D(trial_key<kind::pose_2D, P, 'x'>{}, trial_key<k, P, 'b'>{}, trial_key<k, P>{}),
                 weight_on<k, P>());
  }
}
template <class Core, std::size_t... P>
constexpr auto carried(const Core& core, std::index_sequence<P...>) {
  constexpr kind last = Core::ports.back().what;
  constexpr bool end =
      Core::ports.back().how == access::out && (kte::detail::is_transmission<Core> || last == kind::gen);
  const auto e = chain(carrier<Core, P>()..., element<Core, trial_key<Core::ports[P].what, P>...>{core});
  if constexpr (end)
    return chain(e, weight_on<last, sizeof...(P) - 1>());
  else
    return e;
}
/// The elements of a static chain, appended one by one to a runtime chain.
template <class Gravity, class... E>
runtime_chain loose(const static_chain<Gravity, E...>& c) {
  runtime_chain r;
  boost::hana::for_each(c.elements(), [&r](const auto& e) { r << kte::detail::with_texts(e); });
  return r;
}
}  // namespace detail

/// For elements supported by dynamics: in a static and in a runtime chain, connected only to floating bodies and masses
/// on coordinates, the element gives equal motions, loads, forces of inverse dynamics and accelerations of forward
/// dynamics, at random states. Returns the difference, which is rounding; forward dynamics multiplies it by the
/// condition number of the mass matrix. If the compiler fuses no products, results of passes are bit-identical.
template <class Core, class Draw>
double static_is_runtime(const Core& core, Draw&& draw) requires requires {
  Core::ports;
}
{
  const auto fixed = detail::carried(core, std::make_index_sequence<port_count<Core>>{});
  const auto loose = detail::loose(fixed);
  auto s = make_state(fixed);
  auto r = loose.make_state();
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    detail::draw_motion(s, r, draw);
    const auto g = detail::gap_of_passes(fixed, s, loose, r, draw);
    worst = detail::worse(worst, g.most / g.size);
    if constexpr (decltype(fixed)::dofs > 0) {
      detail::draw_motion(s, r, draw);
      const auto off = [](const auto& a, const auto& b) {
        detail::gap x;
        for (Eigen::Index k = 0; k < a.size(); ++k) x.add(a[k], b[k]);
        return x.most / x.size;
      };
      worst = detail::worse(worst, off(inverse_dynamics(fixed, s), inverse_dynamics(loose, r)));
      worst = detail::worse(worst, off(forward_dynamics(fixed, s), forward_dynamics(loose, r)));
    }
  }
  return worst;
}
template <class Core, class... Keys, class Draw>
double static_is_runtime(const element<Core, Keys...>& e, Draw&& draw) {
  return static_is_runtime(e.core, draw);
}
template <class Core, class Draw>
double static_is_runtime(const named_element<Core>& e, Draw&& draw) {
  return static_is_runtime(e.core, draw);
}

}  // namespace kte::testing
