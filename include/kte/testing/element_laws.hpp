#pragma once

#include <kte/testing/detail/numeric.hpp>
#include <kte/testing/detail/trial.hpp>

/// Laws of mechanics for elements of kte and of users. Each function tries one law on random motions and returns the
/// largest violation, relative to the numbers in it; NaN if a number was NaN. No test framework is needed:
///
///   std::mt19937 engine;
///   const auto draw = [&] { return engine() * 0x1p-31 - 1; };                       // numbers in [-1, 1)
///   assert(kte::testing::power_is_kept<double>(my_joint("q", "base", "end"), draw) < 1e-14);
///
/// S is the scalar. Laws with a derivative hold to about 10 eps^(2/3), which is 4e-10 for double, the others to a few
/// eps. They hold to all digits of a multiprecision S if the parameters of the element have them (a rotation is
/// orthonormal only to its last digit). Laws of whole chains are in testing/file_round_trip.hpp and
/// testing/static_is_runtime.hpp.
namespace kte::testing {

namespace detail {
/// The largest violation in 20 tries.
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
template <class Draw, class T>
void accelerate_randomly(T& thing, Draw& draw) {
  using kte::detail::visit_a;
  if constexpr (coordinate<T>) {
    visit_a(thing, [&draw](auto& a) { a = std::remove_cvref_t<decltype(a)>(draw()); });
  } else if constexpr (frame<T>) {
    kte::detail::visit_rates(thing.acceleration, thing.ang_acceleration,
                             [&draw](auto& a) { a = std::remove_cvref_t<decltype(a)>(draw()); });
  }
}
/// The loads by port; none on signals.
template <class S, class Core>
std::array<std::array<S, 6>, port_count<Core>> loads_of(trial<S, Core>& x) {
  std::array<std::array<S, 6>, port_count<Core>> all{};
  std::size_t p = 0;
  x.for_each([&](const port&, auto& thing) {
    if constexpr (requires { own_load(thing); }) all[p] = own_load(thing);
    ++p;
  });
  return all;
}
/// The loads of doForce, minus those without accelerations.
template <class S, class Core>
auto loads_by_accelerations(trial<S, Core> x) {
  auto resting = x;
  resting.for_each([](const port&, auto& thing) { do_not_accelerate(thing); });
  x.doForce(), resting.doForce();
  auto loads = loads_of(x);
  const auto others = loads_of(resting);
  for (std::size_t p = 0; p < loads.size(); ++p)
    for (std::size_t i = 0; i < 6; ++i) loads[p][i] = loads[p][i] - others[p][i];
  return loads;
}
/// The virtual power of the loads of x on the accelerations of y, and the sum of the absolute values of its terms.
template <class S, class Core>
std::pair<S, S> power_on_accelerations(trial<S, Core>& x, trial<S, Core>& y) {
  const auto loads = loads_of(x);
  S sum(0), sizes(0);
  std::size_t p = 0;
  y.for_each([&](const port&, auto& thing) {
    std::size_t i = 0;
    const auto add = [&](const S& a, std::size_t at) {
      sum = sum + loads[p][at] * a, sizes = sizes + magnitude(S(loads[p][at] * a));
    };
    using T = std::remove_cvref_t<decltype(thing)>;
    if constexpr (coordinate<T>) {
      kte::detail::visit_a(thing, [&](const S& a) { add(a, i++); });
    } else if constexpr (frame<T>) {
      const auto m = spatial(thing);
      const auto a = as<S>(m.acceleration), al = as<S>(m.ang_acceleration);
      for (const S& n : {a.x, a.y, a.z, al.x, al.y, al.z}) add(n, i++);
    }
    ++p;
  });
  return {sum, sizes};
}
}  // namespace detail

/// For elements that move something: velocities and accelerations of their outputs are the derivatives of position and
/// rotation, along any motion of their inputs. Returns the largest violation.
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

/// For transmissions: the power of a load on the outputs is that of the resulting loads on the inputs. Returns the
/// violation.
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

/// For elements with a potential energy(inputs...), such as springs: the power of their loads is the decrease of the
/// energy. Returns the violation.
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

/// For dissipative elements, such as dampers: their loads never do positive work. Returns the violation, the work done.
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

/// For elements between several frames or coordinates: action is reaction. Loads on coordinates sum to zero; so do
/// forces on frames, and torques about the origin of the world. Returns the violation.
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

/// For elements with a `mass<S>()`: their loads in doForce are those of this mass, so that mass matrix and inverse
/// dynamics agree. Loads without accelerations are subtracted. Returns the violation.
template <class S, class Element, class Draw>
S mass_is_that_of_force(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [&e](auto& x) {
    x.for_each([](const port&, auto& thing) { detail::stop(thing); });
    const auto resists = detail::resistance(x.template at<0>(), e.core.template mass<S>());
    const auto loads = detail::loads_by_accelerations(x);
    return detail::difference<S, 6>(loads[0], resists);
  });
}
/// For elements with a distributed mass: `mass_loads` are the loads of their accelerations in doForce, and those of a
/// symmetric, positive semidefinite mass. Returns the violation.
template <class S, class Element, class Draw>
S distributed_mass_is_that_of_force(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [&draw](auto& x) {
    x.for_each([](const port&, auto& thing) { detail::stop(thing); });
    const auto loads = detail::loads_by_accelerations(x);
    auto y = x;  // equal positions, different accelerations
    y.for_each([&draw](const port&, auto& thing) { detail::accelerate_randomly(thing, draw); });
    x.clear(), y.clear();
    x.mass_force(), y.mass_force();
    S worst(0);
    for (std::size_t p = 0; p < loads.size(); ++p)
      worst = detail::worse(worst, detail::difference<S, 6>(loads[p], detail::loads_of(x)[p]));
    const auto [xy, size] = detail::power_on_accelerations(x, y);
    const auto [yx, other] = detail::power_on_accelerations(y, x);
    const auto [xx, own] = detail::power_on_accelerations(x, x);
    worst = detail::worse(worst, detail::ratio(S(xy - yx), S(size + other)));
    return xx > 0 ? detail::worse(worst, detail::ratio(xx, own)) : worst;
  });
}
/// For elements that do not depend on a position or direction in the world: a rigid motion of the whole leaves their
/// loads, in axes of the frames, unchanged. Returns the violation.
template <class S, class Element, class Draw>
S same_anywhere(const Element& e, Draw&& draw) {
  return detail::worst_of_many<S>(e.core, draw, [&draw](auto& x) {
    auto y = x;
    const vec3<S> turn{S(2 * draw()), S(2 * draw()), S(2 * draw())}, shift{S(draw()), S(draw()), S(draw())};
    const auto r = matrix(turn);
    y.for_each([&](const port&, auto& thing) { detail::shift_world(thing, r, shift); });
    x.doForce(), y.doForce();
    const auto a = detail::loads_of(x), b = detail::loads_of(y);
    S worst(0);
    for (std::size_t p = 0; p < a.size(); ++p) worst = detail::worse(worst, detail::difference<S, 6>(a[p], b[p]));
    return worst;
  });
}
/// For an element with typed constants and one with equal numbers: they have equal motions and loads. Returns the
/// difference.
template <class S, class Typed, class Plain, class Draw>
S typed_is_plain(const Typed& typed, const Plain& plain, Draw&& draw) {
  return detail::worst_of_many<S>(typed.core, draw, [&](auto& x) {
    constexpr port last = Typed::core_type::ports.back();
    constexpr bool moves = last.how == access::out && !is_signal(last.what);
    if constexpr (moves) detail::load_randomly(x.output(), draw);
    auto y = x.with(plain.core);
    S worst(0);
    if constexpr (moves) {
      x.doMotion(), y.doMotion();
      const auto a = detail::numbers(x.output());
      worst = detail::difference<S, std::tuple_size_v<decltype(a)>>(a, detail::numbers(y.output()));
    }
    x.doForce(), y.doForce();
    const auto a = detail::loads_of(x), b = detail::loads_of(y);
    for (std::size_t p = 0; p < a.size(); ++p) worst = detail::worse(worst, detail::difference<S, 6>(a[p], b[p]));
    return worst;
  });
}

}  // namespace kte::testing
