#pragma once

#include <kte/testing/detail/numeric.hpp>
#include <kte/testing/detail/trial.hpp>

/// Laws of mechanics that elements obey: yours too, if you test it by these. Each function tries one law on random
/// motions and returns the largest violation, relative to the numbers in it; NaN if a number was none. They need no
/// test framework:
///
///   std::mt19937 engine;
///   const auto draw = [&] { return engine() * 0x1p-31 - 1; };                       // numbers in [-1, 1)
///   assert(kte::testing::power_is_kept<double>(my_joint("q", "base", "end"), draw) < 1e-14);
///
/// S is the scalar. Laws with a derivative hold to some 10 eps^(2/3), which is 4e-10 for double, the others to a few
/// eps. In S of many digits they hold to as many, if the element's parameters have them (a rotation is one only to its
/// last digit).
namespace kte::testing {

namespace detail {
/// The worst of 20 tries.
template <class S, class Core, class Draw, class Violation>
S worst_of_many(const Core& core, Draw& draw, const Violation& violation) {
  S worst(0);
  for (int i = 0; i < 20; ++i) {
    trial<S, Core> x(core, draw);
    worst = worse(worst, S(violation(x)));
  }
  return worst;
}
template <class Draw, class S>
void load_randomly(gen_coord<S>& c, Draw& draw) {
  c.f = S(draw());
}
template <class Draw, class S>
void load_randomly(frame_2D<S>& x, Draw& draw) {
  x.force = {S(draw()), S(draw())}, x.torque = S(draw());
}
template <class Draw, class S>
void load_randomly(frame_3D<S>& x, Draw& draw) {
  x.force = {S(draw()), S(draw()), S(draw())}, x.torque = {S(draw()), S(draw()), S(draw())};
}
}  // namespace detail

/// For elements that move something: velocities and accelerations of what they move are derivatives of its position and
/// rotation, along any motion of what they read.
template <class S, class Element, class Draw>
S motion_is_derivative(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [](auto& x) {
    x.doMotion();
    const auto [first, second] = detail::derivatives<S>([&x](const S& t) {
      auto y = x;
      y.move(t);
      return detail::numbers(y.output());
    });
    return detail::off(x.output(), first, second);
  });
}

/// For transmissions: the power of a load on what they move is that of the loads which they put on what they read.
template <class S, class Element, class Draw>
S power_is_kept(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [&draw](auto& x) {
    x.doMotion();
    detail::load_randomly(x.output(), draw);
    x.doForce();
    const auto [out, size] = detail::power(x.output());
    S sum = -2 * out, sizes(0);
    x.for_each([&](const port&, auto& thing) {
      const auto [p, s] = detail::power(thing);
      sum = sum + p, sizes = sizes + s;
    });
    return detail::ratio(sum, sizes);
  });
}

/// For springs and the like, of the given energy(things it reads...): the power of their loads is the energy's
/// decrease.
template <class S, class Element, class Draw, class Energy>
S force_is_gradient(const Element& e, Draw&& draw, const Energy& energy) {
  return detail::worst_of_many<S>(e.core, draw, [&energy](auto& x) {
    x.doForce();
    S sum(0);
    x.for_each([&sum](const port&, auto& thing) { sum = sum + detail::power(thing).first; });
    const auto change = detail::derivatives<S>([&](const S& t) {
      auto y = x;
      y.move(t);
      return std::array<S, 1>{y.apply(energy)};
    });
    return detail::difference<S, 1>({sum}, {S(-change.first[0])});
  });
}

/// For dampers and the like: their loads never do work; the violation is the work done.
template <class S, class Element, class Draw>
S no_work_done(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [](auto& x) {
    x.doForce();
    S sum(0), sizes(0);
    x.for_each([&](const port&, auto& thing) {
      const auto [p, s] = detail::power(thing);
      sum = sum + p, sizes = sizes + s;
    });
    return sum <= 0 ? S(0) : detail::ratio(sum, sizes);
  });
}

/// For elements between several things: action is reaction. Loads on coordinates add up to nothing; so do forces on
/// frames, and torques about the origin of the world.
template <class S, class Element, class Draw>
S loads_are_opposite(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [](auto& x) {
    x.doForce();
    std::array<S, 7> sum{}, sizes{};
    x.for_each([&](const port&, auto& thing) {
      const auto l = detail::load_in_world(thing);
      for (std::size_t i = 0; i < 7; ++i) sum[i] = sum[i] + l[i], sizes[i] = sizes[i] + detail::magnitude(l[i]);
    });
    return detail::balance(sum, sizes);
  });
}

/// For elements with a `mass<S>()`: it is the mass by which they resist in doForce, so that mass matrix and inverse
/// dynamics agree.
template <class S, class Element, class Draw>
S mass_is_that_of_force(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [&e](auto& x) {
    auto& thing = x.template at<0>();
    detail::stop(thing);
    x.doForce();
    return detail::resistance_off(thing, e.core.template mass<S>());
  });
}

}  // namespace kte::testing
