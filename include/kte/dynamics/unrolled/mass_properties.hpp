#pragma once

#include <kte/dynamics/unrolled/bodies.hpp>
#include <kte/dynamics/unrolled/given_bases.hpp>
#include <kte/recursions/composite_body.hpp>

/// Mass, centre of mass and momentum of static chains.
namespace kte::detail {

/// The sum of f<Frame>(x) over all frames that act as bases. For bases x is no motion; for frames with a given motion x
/// is that motion, relative to bases with common origin and axes.
template <class Motion, class F>
KTE_INLINE constexpr auto sum_over_grounds(const Motion& m, const F& f) {
  using wiring = typename Motion::wiring;
  using chain = typename Motion::chain_type;
  using types = typename Motion::types;
  const auto of_base = [&]<kind K, int Slot>() KTE_INLINE_LAMBDA {
    return f.template operator()<frame_place<K, Slot>>(pose{no_rotation{}, zero3{}});
  };
  const auto of_element = [&]<std::size_t I>() KTE_INLINE_LAMBDA {
    constexpr kind k = types::template output_kind<I>;
    constexpr int slot = types::template output_slot<I>;
    const auto& x = m.template get<k, slot>();
    return f.template operator()<frame_place<k, slot>>(pose{x.rotation, x.position});
  };
  return sum_over_bases<wiring>(no_mass, of_base) + [&]<std::size_t... I>(std::index_sequence<I...>) KTE_INLINE_LAMBDA {
    return (no_mass + ... + of_element.template operator()<I>());
  }
  (typename given_bases<chain>::type{});
}

inline constexpr same_base base_of_nothing{motion{skip{}, skip{}, skip{}, skip{}, skip{}, skip{}}};

/// The composite inertia of a chain at `Given`, about the origin of its bases and in their axes; step: of each body
/// with the inertia that it carries.
template <class S, class Motion, class Step = engine::same_inertia>
KTE_INLINE auto composite_inertia_at_base(const Motion& m, const Step& step = {}) {
  using chain_type = typename Motion::chain_type;
  static_assert(sizeof(passed_over<chain_type>) > 0);
  using bodies_type = typed_bodies<S, Motion, axes_of_joints<chain_type>>;
  const bodies_type bodies(m);
  const engine::unrolled<bodies_type> d{bodies};
  return sum_over_grounds(m, [&]<class Frame>(const auto& x) KTE_INLINE_LAMBDA {
    return transported(x.rotation, x.position, engine::composite_inertia_of<Frame>(d, step));
  });
}
/// (1) and (2) of `centre_of_mass`.
template <class S, class Chain, class At>
KTE_INLINE auto weight_of(const Chain& c, const At& at) {
  const given g{at, same<skip>{}, same<skip>{}, base_with_pose};
  return composite_inertia_at_base<S>(unrolled_motion<Chain, std::remove_const_t<decltype(g)>>(c, g));
}
/// The pose of the end of a body, seen from a point.
template <class Motion, class P>
KTE_INLINE auto poses_from(const Motion& m, const P& point) {
  return [&m, &point]<class Place>(const Place&) KTE_INLINE_LAMBDA {
    using types = typename Motion::types;
    const auto& x =
        m.template get<types::template output_kind<Place::number>, types::template output_slot<Place::number>>();
    return pose{x.rotation, x.position - point};
  };
}
/// A sum of m x divided by the mass.
template <class S, class M, class X, class Diagnose = too_large>
KTE_INLINE vec3<S> divided_by_mass(const M& mass, const X& sum, const Diagnose& why = {"a centre of mass"}) {
  static_assert(!std::is_same_v<M, zero_t>, "kte: a chain without bodies has no centre of mass");
  const vec3<S> s = as<S>(sum), r{s.x / as<S>(mass), s.y / as<S>(mass), s.z / as<S>(mass)};
  const S numbers[]{r.x, r.y, r.z};
  check_result(numbers, 3, [&]() KTE_INLINE_LAMBDA {
    if (!all(as<S>(mass) == S(0))) why();
    raise<bad_argument>("kte: a chain whose mass is zero has no centre of mass");
  });
  return r;
}

/// The sum on bases of what elements have as `Loads` (unrolled/other_loads.hpp); bases have common origin and axes.
template <class Loads, class Chain, class Given>
KTE_INLINE auto loads_on_bases(const Chain& c, const Given& g) {
  const with_loads<Chain, Loads> with{c};
  const unrolled_passes<with_loads<Chain, Loads>, Given> pass(with, g);
  return sum_over_bases<typename Chain::wiring>(
      no_wrench, [&pass]<kind K, int Slot>() KTE_INLINE_LAMBDA { return pass.template load<K, Slot>(); });
}
/// The sum of the momenta of all bodies with bases at rest, about their origin and in their axes.
template <class S, class Chain, class At, class V>
KTE_INLINE auto momentum_at_base(const Chain& c, const At& at, const V& v) {
  const given g{at, v, same<skip>{}, rest_base_of<Chain>(base_with_velocity)};
  return loads_on_bases<momenta<S>>(c, g);
}

}  // namespace kte::detail
